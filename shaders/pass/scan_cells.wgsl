// Exclusive prefix sum of the cells' counts, in blocks whose totals are summed in between.
// Twin: src/pass/scan_cells.rs
#import invocation
#import params

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> cell_count: array<u32>;
@group(0) @binding(_) var<storage, read_write> cell_start: array<u32>;
@group(0) @binding(_) var<storage, read_write> cell_block: array<u32>;

const THREADS: u32 = 256u;
const EACH: u32 = 4u;
const SCAN_BLOCK: u32 = 1024u;

var<workgroup> shared_sum: array<u32, 256>;

// Inclusive prefix sum over the workgroup; leaves the total in the last place.
fn scan_group(local: u32, value: u32) -> u32 {
    workgroupBarrier();
    shared_sum[local] = value;
    workgroupBarrier();
    var sum = value;
    for (var offset = 1u; offset < THREADS; offset *= 2u) {
        if local >= offset {
            sum += shared_sum[local - offset];
        }
        workgroupBarrier();
        shared_sum[local] = sum;
        workgroupBarrier();
    }
    return sum;
}

// Prefix sum inside each block, and the block's total.
@compute @workgroup_size(256)
fn blocks(invocation: Invocation) {
    if clock.running == 0u || clock.rebuild == 0u {
        return;
    }
    let block = block_of(invocation);
    let first = block * SCAN_BLOCK + invocation.local * EACH;
    var counts: array<u32, EACH>;
    var own = 0u;
    for (var k = 0u; k < EACH; k++) {
        if first + k < params.cell_total {
            counts[k] = cell_count[first + k];
        }
        own += counts[k];
    }
    let through = scan_group(invocation.local, own);
    var total = through - own;
    for (var k = 0u; k < EACH; k++) {
        if first + k < params.cell_total {
            cell_start[first + k] = total;
        }
        total += counts[k];
    }
    if invocation.local == THREADS - 1u && block * SCAN_BLOCK < params.cell_total {
        cell_block[block] = through;
    }
}

// Totals of the blocks into the number of particles before each: one workgroup walks over all.
@compute @workgroup_size(256)
fn totals(invocation: Invocation) {
    if clock.running == 0u || clock.rebuild == 0u {
        return;
    }
    let count = (params.cell_total + SCAN_BLOCK - 1u) / SCAN_BLOCK;
    var before = 0u;
    for (var first = 0u; first < count; first += THREADS) {
        let block = first + invocation.local;
        var own = 0u;
        if block < count {
            own = cell_block[block];
        }
        let through = scan_group(invocation.local, own);
        if block < count {
            cell_block[block] = before + through - own;
        }
        before += shared_sum[THREADS - 1u];
    }
    if invocation.local == 0u {
        cell_start[params.cell_total] = before;
    }
}

@compute @workgroup_size(256)
fn offsets(invocation: Invocation) {
    if clock.running == 0u || clock.rebuild == 0u {
        return;
    }
    let block = block_of(invocation);
    for (var k = 0u; k < EACH; k++) {
        let cell = block * SCAN_BLOCK + k * THREADS + invocation.local;
        if cell < params.cell_total {
            cell_start[cell] += cell_block[block];
        }
    }
}
