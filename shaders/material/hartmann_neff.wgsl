// Volumetric elasticity of Hartmann & Neff 2003. Twin: src/material/hartmann_neff.rs
#import params
#import volumetric_stress

// Mean Kirchhoff stress.
fn kirchhoff_hartmann_neff(body: Body, volume_change: real) -> real {
    return volumetric_stress(body.bulk_modulus, volume_change);
}
