// What a material answers to deformation. Twin: src/material/mod.rs
#import tensor

// P = K (rho/rho_0 - 1) = -K e/(1 + e), e the volumetric strain.
fn pressure(bulk_modulus: real, strain: real) -> real {
    return -bulk_modulus * strain / (1.0 + strain);
}

// 2 mu (D - tr D/3), Fuller (2.40); plane strain and uniaxial strain keep the third of the trace that the
// missing axes carry.
fn deviatoric_rate(shear_modulus: real, velocity_gradient: Mat) -> Sym {
    let third = trace(velocity_gradient) * (1.0 / 3.0);
    return sym_scale(sym_sub(sym_part(velocity_gradient), diagonal(third)), 2.0 * shear_modulus);
}
