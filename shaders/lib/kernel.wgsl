// The smoothing kernel with its dimensions: W(r, h) = C_D / h^D w(q), q = r/h. Twin: Scaled in src/smoothing/mod.rs
#import params
#import smoothing

// h^D
fn to_dimension(h: real) -> real {
#if line
    return h;
#endif
#if plane
    return h * h;
#endif
#if solid
    return h * h * h;
#endif
}

// W(r, h), in 1/length^D.
fn weight(r: real, h: real) -> real {
    return params.normalisation * shape(r / h) / to_dimension(h);
}

// (dW/dr)/r, the factor of the separation in the gradient, in 1/length^(D+2). Where two points coincide, as a
// particle on a mirror plane and its image do, the bound keeps the divisor a normal number and the result finite.
fn gradient(r: real, h: real) -> real {
    return params.normalisation * slope(r / h) / (to_dimension(h) * h * max(r, 1e-6 * h));
}
