// Ascending order inside each cell, so that sums do not depend on the threads. Twin: src/pass/sort_cells.rs
#import params

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> cell_start: array<u32>;
@group(0) @binding(_) var<storage, read_write> cell_particles: array<u32>;

fn of_cell(cell: u32) {
    // A cell holds few particles: insertion sort.
    let first = cell_start[cell];
    let end = cell_start[cell + 1u];
    for (var k = first + 1u; k < end; k++) {
        let particle = cell_particles[k];
        var place = k;
        while place > first {
            let before = cell_particles[place - 1u];
            if before <= particle {
                break;
            }
            cell_particles[place] = before;
            place -= 1u;
        }
        cell_particles[place] = particle;
    }
}
