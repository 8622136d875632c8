// The largest of each of four numbers over all particles, block by block. Twin: largest in src/pass/bound_time_step.rs
const REDUCTION_BLOCK: u32 = 256u;

var<workgroup> shared_bound: array<vec4<real>, 256>;

// Largest of each component over the workgroup; good in its first invocation.
//
// Two rounds of sixteen, not eight of two: a software driver pays for every barrier.
fn largest(local: u32, own: vec4<real>) -> vec4<real> {
    shared_bound[local] = own;
    workgroupBarrier();
    if local < 16u {
        for (var k = local + 16u; k < REDUCTION_BLOCK; k += 16u) {
            shared_bound[local] = max(shared_bound[local], shared_bound[k]);
        }
    }
    workgroupBarrier();
    var bound = shared_bound[0];
    for (var k = 1u; k < 16u; k += 1u) {
        bound = max(bound, shared_bound[k]);
    }
    return bound;
}
