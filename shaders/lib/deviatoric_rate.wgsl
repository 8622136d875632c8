// Rate of a hypoelastic deviator. Twin: deviatoric_rate in src/material/mod.rs
#import tensor

// 2 mu (D - tr D/3), Fuller (2.40); plane strain and uniaxial strain keep the third of the trace that the
// missing axes carry.
fn deviatoric_rate(shear_modulus: real, velocity_gradient: Mat) -> Sym {
    let third = trace(velocity_gradient) * (1.0 / 3.0);
    return sym_scale(sym_sub(sym_part(velocity_gradient), diagonal(third)), 2.0 * shear_modulus);
}
