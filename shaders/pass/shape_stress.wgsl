// Stress from the deformation gradient, as the gradients of the shape functions carry it: in the current
// configuration Kirchhoff's, in the reference configuration the first Piola-Kirchhoff stress; and J - 1, for the
// present volumes. A law that remembers takes its memory to the end of the step first.
// Twin: src/pass/shape_stress.rs
#import body
#import laws

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> displacement_gradient: array<Mat>;
#if memory
@group(0) @binding(_) var<storage, read_write> inelastic_strain: array<Sym>;
#endif
#if current
@group(0) @binding(_) var<storage, read_write> volumetric_strain: array<real>;
#endif
@group(0) @binding(_) var<storage, read_write> shape_stress: array<Mat>;

fn of_particle(a: u32) {
    let own = body_of(a);
    let gradient = displacement_gradient[a];
#if memory
    let memory = relax(own, gradient, Memory(inelastic_strain[a], 0.0, 0.0), clock.step).strain;
    inelastic_strain[a] = memory;
    let stress = first_piola(own, gradient, memory);
#else
    let stress = first_piola(own, gradient, Sym());
#endif
#if current
    shape_stress[a] = stress + mat_mat(stress, transpose_mat(gradient));
    volumetric_strain[a] = volume_change(gradient);
#else
    shape_stress[a] = stress;
#endif
}
