// Strength of the hourglass energy times Young's modulus; where a body has flowed, times the square of the secant of its
// perfectly plastic stress over strain. The pass declares the plastic strain. Twin: hourglass_stiffness in src/bond.rs
#import body
#if body_options
#import body_options
#endif

fn hourglass_stiffness(a: u32, own: Body) -> real {
#if body_options
    let elastic = options_of(a).hourglass * own.youngs_modulus;
#else
    let elastic = params.hourglass * own.youngs_modulus;
#endif
#if plastic
    if own.yield_stress != 0.0 {
        // In a descent to equilibrium the strain is that of the last equilibrium.
#if quasi_static
        let k = equilibrium_plastic_strain[a];
#else
        let k = equivalent_plastic_strain[a];
#endif
        let secant = own.yield_stress / (own.yield_stress + 3.0 * own.shear_modulus * k);
        return elastic * secant * secant;
    }
#endif
    return elastic;
}
