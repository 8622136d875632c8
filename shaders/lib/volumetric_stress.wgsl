// k/10 (J^5 - J^-5) from J - 1, Hartmann & Neff 2003. Twin: src/material/hartmann_neff.rs
#import strain

fn volumetric_stress(bulk_modulus: real, volume_change: real) -> real {
    let p = fifth_power_change(volume_change);
    return bulk_modulus * 0.1 * p * (2.0 + p) / (1.0 + p);
}
