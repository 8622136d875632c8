// Cell of each particle and number of particles of each cell. Twin: src/pass/bin_cells.rs
#import cell

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> reference_position: array<Vec>;
@group(0) @binding(_) var<storage, read> displacement: array<Vec>;
@group(0) @binding(_) var<storage, read_write> cell: array<u32>;
@group(0) @binding(_) var<storage, read_write> cell_count: array<atomic<u32>>;

// Particles are sorted where they are in the reference configuration.
override stage_reference: bool;

fn of_particle(i: u32) {
    let place = cell_of(reference_position[i] + select(displacement[i], Vec(), stage_reference));
    let index = (place.z * params.cells_y + place.y) * params.cells_x + place.x;
    cell[i] = index;
    atomicAdd(&cell_count[index], 1u);
}
