// Strength of the hourglass energy times Young's modulus; where a body has flowed, times the square of the secant of its
// perfectly plastic stress over strain. The pass declares the plastic strain. Twin: hourglass_stiffness in src/bond.rs
#import body
#import body_options

fn hourglass_stiffness(a: u32, own: Body) -> real {
    let elastic = options_of(a).hourglass * own.youngs_modulus;
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
