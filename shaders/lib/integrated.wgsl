// QUANTITY, integrated from RATE by the stages of a step. The pass declares `clock` and what a stage is.
// Twin: advance in src/pass/runge_kutta.rs
@group(0) @binding(_) var<storage, read> RATE: array<TYPE>;
@group(0) @binding(_) var<storage, read_write> QUANTITY: array<TYPE>;
@group(0) @binding(_) var<storage, read_write> QUANTITY_start: array<TYPE>;
@group(0) @binding(_) var<storage, read_write> QUANTITY_sum: array<TYPE>;

fn advance_QUANTITY(a: u32) {
    let rate = RATE[a];
    var start = QUANTITY_start[a];
    var sum = QUANTITY_sum[a];
    if stage_first {
        start = QUANTITY[a];
        sum = TYPE();
        QUANTITY_start[a] = start;
    }
    sum += rate * stage_weight;
    QUANTITY[a] = start + (sum * stage_of_sum + rate * stage_of_rate) * clock.step;
    QUANTITY_sum[a] = sum;
}
