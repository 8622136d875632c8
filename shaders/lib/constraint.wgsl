// Which boundary condition holds for a particle: 0 for none, else its place in the table counted from 1.

@group(0) @binding(_) var<storage, read> constraint: array<u32>;
