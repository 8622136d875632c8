// The deviatoric stress, integrated from its rate as other quantities are by integrated.wgsl, but with functions in place of
// the operators that WGSL lacks for Sym. Twin: advance in src/pass/runge_kutta.rs
@group(0) @binding(_) var<storage, read> deviatoric_stress_rate: array<Sym>;
@group(0) @binding(_) var<storage, read_write> deviatoric_stress: array<Sym>;
@group(0) @binding(_) var<storage, read_write> deviatoric_stress_start: array<Sym>;
@group(0) @binding(_) var<storage, read_write> deviatoric_stress_sum: array<Sym>;

fn advance_deviatoric_stress(a: u32) {
    let rate = deviatoric_stress_rate[a];
    var start = deviatoric_stress_start[a];
    var sum = deviatoric_stress_sum[a];
    if stage_first {
        start = deviatoric_stress[a];
        sum = Sym();
        deviatoric_stress_start[a] = start;
    }
    sum = sym_add(sum, sym_scale(rate, stage_weight));
    let slope = sym_add(sym_scale(sum, stage_of_sum), sym_scale(rate, stage_of_rate));
    deviatoric_stress[a] = sym_add(start, sym_scale(slope, clock.step));
    deviatoric_stress_sum[a] = sum;
}
