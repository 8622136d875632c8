// The cells around a point. The pass declares `cell_start`, a structure Search, and
// visit(search, first, end, found), which looks at a stretch of `cell_particles` and gives the new number found.
// Twin: visit_cells in src/pass/find_neighbors.rs
#import cell

// Found more than the list can hold.
const TOO_MANY: u32 = 0xffffffffu;

// First and last cell along an axis, beyond the grid's end where it wraps.
fn range_of(cell: u32, cells: u32, period: real, axis: u32) -> vec2<i32> {
    if axis >= DIMENSION {
        return vec2<i32>(0);
    }
    let wraps = period > 0.0;
    let low = select(i32(cell) - 1, 0, cell == 0u && !wraps);
    let high = select(i32(cell) + 1, i32(cell), cell + 1u == cells && !wraps);
    return vec2<i32>(low, high);
}

fn wrap(cell: i32, cells: u32) -> u32 {
#if periodic
    return u32(cell + i32(cells)) % cells;
#else
    return u32(cell);
#endif
}

// Visits every particle of the cells around a point; takes and returns the number found.
fn visit_cells(search: Search, center: Vec, found_before: u32) -> u32 {
    let cell = cell_of(center);
    let xs = range_of(cell.x, params.cells_x, params.period_x, 0u);
    let ys = range_of(cell.y, params.cells_y, params.period_y, 1u);
    let zs = range_of(cell.z, params.cells_z, params.period_z, 2u);
    var found = found_before;
    for (var z = zs.x; z <= zs.y; z++) {
        for (var y = ys.x; y <= ys.y; y++) {
            let row = (wrap(z, params.cells_z) * params.cells_y + wrap(y, params.cells_y)) * params.cells_x;
            // Cells along x are contiguous, so a row is one range unless the box wraps along x.
            var first = xs.x;
            while first <= xs.y && found != TOO_MANY {
                let start = wrap(first, params.cells_x);
                let width = min(u32(xs.y - first), params.cells_x - 1u - start);
                found = visit(search, cell_start[row + start], cell_start[row + start + width + 1u], found);
                first += i32(width) + 1;
            }
        }
    }
    return found;
}
