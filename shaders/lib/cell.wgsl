// Cell coordinates of a point. Twin: cell_of in src/pass/bin_cells.rs
#import params

// Points outside the grid belong to the cell at its edge; a periodic axis wraps; a missing axis has cell 0.
fn cell_of(x: Vec) -> vec3<u32> {
    let cells = vec3<u32>(params.cells_x, params.cells_y, params.cells_z);
    let last = vec_of(real(cells.x) - 1.0, real(cells.y) - 1.0, real(cells.z) - 1.0);
    let size = vec_of(params.cell_x, params.cell_y, params.cell_z);
    var distance = x - vec_of(params.origin_x, params.origin_y, params.origin_z);
#if periodic
    let period = vec_of(params.period_x, params.period_y, params.period_z);
    // An open axis has period 0: nothing is taken off.
    let divisor = select(period, Vec(1.0), period <= Vec(0.0));
    distance -= period * floor(distance / divisor);
#endif
    let cell = min(max(floor(distance / size), Vec(0.0)), last);
    // The second bound holds a point that is not a number inside the table.
    return min(vec3<u32>(vec_to(cell)), cells - 1u);
}
