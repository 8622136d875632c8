// Moves facets with their particles: x = x_p + F_p (X - X_p), n = F_p^-T N/|F_p^-T N|. Twin: src/pass/place_facets.rs
#import params
#import facet_lever

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> displacement: array<Vec>;
@group(0) @binding(_) var<storage, read> displacement_gradient: array<Mat>;
@group(0) @binding(_) var<storage, read> facet_reference_normal: array<Vec>;
@group(0) @binding(_) var<storage, read_write> facet_displacement: array<Vec>;
@group(0) @binding(_) var<storage, read_write> facet_normal: array<Vec>;
#if friction
@group(0) @binding(_) var<storage, read_write> facet_move: array<Vec>;
#endif
#if gap
@group(0) @binding(_) var<storage, read_write> facet_pressed: array<u32>;
#endif

fn of_facet(e: u32) {
    let a = facet_owner[e];
    let gradient = displacement_gradient[a];
    let moved = displacement[a] + mat_vec(gradient, lever(e));
#if friction
    facet_move[e] = moved - facet_displacement[e];
#endif
    facet_displacement[e] = moved;
    let normal = mat_vec(transpose_mat(adjugate(mat_identity() + gradient)), facet_reference_normal[e]);
    facet_normal[e] = normal * (1.0 / sqrt(inner(normal, normal)));
#if gap
    facet_pressed[e] = 0u;
#endif
}
