// Adds to what the bonds carry the stress that the levers of a particle's facets make: (sum dU/dF)/V K^-1.
// Twin: src/pass/carry_facets.rs
#import params
#import facet_touched

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> first_facet: array<u32>;
@group(0) @binding(_) var<storage, read> facets: array<u32>;
@group(0) @binding(_) var<storage, read> facet_moment: array<Mat>;
@group(0) @binding(_) var<storage, read> reference_volume: array<real>;
#if correct_rate
@group(0) @binding(_) var<storage, read> reference_correction: array<Sym>;
#endif
@group(0) @binding(_) var<storage, read_write> bond_stress: array<Mat>;

fn of_particle(a: u32) {
    if facets[a] == 0u {
        return;
    }
    var sum = Mat();
    let end = first_facet[a] + facets[a];
    for (var e = first_facet[a]; e < end; e++) {
        if facet_touched(e) {
            sum += facet_moment[e];
        }
    }
    let mean = sum * (1.0 / reference_volume[a]);
#if correct_rate
    bond_stress[a] += mat_mat(mean, mat_of_sym(reference_correction[a]));
#else
    bond_stress[a] += mean;
#endif
}
