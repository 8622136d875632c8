// Which particle, cell or block an invocation works on. Groups are folded to two dimensions, since a device
// takes at most 65,535 along each.

struct Invocation {
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
}

fn block_of(invocation: Invocation) -> u32 {
    return invocation.group.x + invocation.group.y * invocation.groups.x;
}

// For workgroups of 64.
fn index_of(invocation: Invocation) -> u32 {
    return block_of(invocation) * 64u + invocation.local;
}
