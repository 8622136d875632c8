// Sums the force on each rigid obstacle, and ends the kick of those that are free. Twin: src/pass/load_obstacles.rs
#import invocation
#import half_kick

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> movers: array<Mover>;
@group(0) @binding(_) var<storage, read> facet_obstacle: array<u32>;
@group(0) @binding(_) var<storage, read> facet_load: array<Vec>;
@group(0) @binding(_) var<storage, read_write> block_load: array<Vec>;
@group(0) @binding(_) var<storage, read_write> obstacle_force: array<Vec>;
@group(0) @binding(_) var<storage, read_write> obstacle_velocity: array<Vec>;

const WIDTH: u32 = 256u;
var<workgroup> parts: array<Vec, WIDTH>;

fn block_count() -> u32 {
    return (params.facet_count + WIDTH - 1u) / WIDTH;
}

// Adds up what the workgroup's invocations hold.
//
// Two rounds of sixteen, not eight of two: a software driver pays for every barrier.
fn gather(local: u32, own: Vec) -> Vec {
    parts[local] = own;
    workgroupBarrier();
    if local < 16u {
        for (var k = local + 16u; k < WIDTH; k += 16u) {
            parts[local] += parts[k];
        }
    }
    workgroupBarrier();
    var sum = parts[0];
    for (var k = 1u; k < 16u; k++) {
        sum += parts[k];
    }
    // All invocations must have read the sum before the next obstacle's parts overwrite it.
    workgroupBarrier();
    return sum;
}

@compute @workgroup_size(256)
fn blocks(invocation: Invocation) {
    let block = block_of(invocation);
    let e = block * WIDTH + invocation.local;
    let inside = e < params.facet_count;
    for (var k = 0u; k < params.obstacle_count; k++) {
        var own = Vec();
        if inside && facet_obstacle[e] == k + 1u {
            own = Vec() - facet_load[e];
        }
        let sum = gather(invocation.local, own);
        if invocation.local == 0u && clock.running != 0u && block < block_count() {
            block_load[k * block_count() + block] = sum;
        }
    }
}

@compute @workgroup_size(256)
fn total(invocation: Invocation) {
    for (var k = 0u; k < params.obstacle_count; k++) {
        var own = Vec();
        for (var block = invocation.local; block < block_count(); block += WIDTH) {
            own += block_load[k * block_count() + block];
        }
        let sum = gather(invocation.local, own);
        if invocation.local == 0u && clock.running != 0u {
            obstacle_force[k] = sum;
            if movers[k].inverse_mass > 0.0 {
                obstacle_velocity[k] += half_kick(k);
            }
        }
    }
}
