"""Exits 0 only if the stock VTK reader and h5py read every step of a .vtkhdf file.

    python3 tests/vtk_reads_output.py FILE        (needs: pip install vtk h5py)

Times must ascend, each step must hold the stored number of points in one poly-vertex cell, every
array must be present and finite, and what VTK hands out must be the rows that the file stores.
"""

import sys

import h5py
import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkIOHDF import vtkHDFReader


def require(condition, message):
    if not condition:
        sys.exit(f"{sys.argv[1]}: {message}")


def stored(path):
    """Times, number of points of each step, points and arrays as h5py sees them."""
    with h5py.File(path, "r") as file:
        root = file["VTKHDF"]
        steps = root["Steps"].attrs["NSteps"]
        for name, data in root["PointData"].items():
            require("unit" in data.attrs, f"array {name} has no unit")
        arrays = {name: data[()] for name, data in root["PointData"].items()}
        return root["Steps/Values"][:steps], root["NumberOfPoints"][:steps], root["Points"][()], arrays


def check_step(k, time, rows, output, points, arrays):
    require(output.GetNumberOfPoints() == len(points[rows]), f"step {k} has {output.GetNumberOfPoints()} points")
    require(output.GetNumberOfCells() == 1, f"step {k} has {output.GetNumberOfCells()} cells, not one poly-vertex")
    require(output.GetCell(0).GetNumberOfPoints() == len(points[rows]), f"the cell of step {k} misses points")
    require(numpy.array_equal(vtk_to_numpy(output.GetPoints().GetData()), points[rows]), f"points of step {k} differ")
    for name, values in arrays.items():
        array = output.GetPointData().GetArray(name)
        require(array is not None, f"array {name} is absent at step {k}")
        seen = vtk_to_numpy(array)
        require(numpy.isfinite(seen).all(), f"array {name} is not finite at step {k}, t = {time}")
        require(numpy.array_equal(seen, values[rows]), f"array {name} differs at step {k}")


def main(path):
    times, counts, points, arrays = stored(path)
    require(len(times) > 0, "there is no step")
    require((numpy.diff(times) > 0).all(), f"times do not ascend: {times}")
    require(numpy.isfinite(points).all(), "points are not finite")
    reader = vtkHDFReader()
    require(reader.CanReadFile(path), "vtkHDFReader refuses it")
    reader.SetFileName(path)
    reader.UpdateInformation()
    announced = reader.GetOutputInformation(0).Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS())
    require(numpy.array_equal(announced or times[:1], times), f"the reader announces {announced}, not {times}")
    ends = numpy.cumsum(counts)
    for k, time in enumerate(times):
        reader.SetStep(k)
        reader.Update()
        rows = slice(ends[k] - counts[k], ends[k])
        check_step(k, time, rows, reader.GetOutputDataObject(0), points, arrays)
    print(f"{path}: {len(times)} steps of {counts[0]} points, arrays {', '.join(sorted(arrays))}")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
