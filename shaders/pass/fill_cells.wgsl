// Puts each particle into its cell's range, taking the counts back down to zero. Threads race for places:
// sort_cells settles the order. Twin: src/pass/fill_cells.rs
#import params

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> cell: array<u32>;
@group(0) @binding(_) var<storage, read> cell_start: array<u32>;
@group(0) @binding(_) var<storage, read_write> cell_count: array<atomic<u32>>;
@group(0) @binding(_) var<storage, read_write> cell_particles: array<u32>;

fn of_particle(i: u32) {
    let own = cell[i];
    let rank = atomicSub(&cell_count[own], 1u) - 1u;
    cell_particles[cell_start[own] + rank] = i;
}
