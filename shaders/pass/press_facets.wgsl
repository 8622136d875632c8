// Force of other bodies' surfaces on each facet, as the facet that measures a gap and as one that another measures
// from, and the derivative of the energy by the deformation gradient of the facet's particle.
// Twin: src/pass/press_facets.rs
#import facet_pair
#import facet_lever
#import facet

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> displacement_gradient: array<Mat>;
@group(0) @binding(_) var<storage, read> facet_displacement: array<Vec>;
@group(0) @binding(_) var<storage, read> facet_normal: array<Vec>;
@group(0) @binding(_) var<storage, read> facet_contacts: array<u32>;
@group(0) @binding(_) var<storage, read> facet_contact_count: array<u32>;
@group(0) @binding(_) var<storage, read> facet_pressed: array<u32>;
@group(0) @binding(_) var<storage, read> facet_pull: array<real>;
#if !along_normals
@group(0) @binding(_) var<storage, read> facet_gap: array<real>;
@group(0) @binding(_) var<storage, read> facet_edge: array<real>;
#endif
#if friction
@group(0) @binding(_) var<storage, read> facet_spread: array<real>;
@group(0) @binding(_) var<storage, read> facet_traction: array<Vec>;
#endif
@group(0) @binding(_) var<storage, read_write> facet_force: array<Vec>;
@group(0) @binding(_) var<storage, read_write> facet_moment: array<Mat>;

// What acts on a facet: the force, minus the derivative of the energy by the facet's normal, and the derivative of the energy
// by F from friction that acts at a point other than the facet's.
struct Load {
    force: Vec,
    turning: Vec,
    aside: Mat,
}

fn of_facet(e: u32) {
    if facet_pressed[e] == 0u {
        facet_force[e] = Vec();
        facet_moment[e] = Mat();
        return;
    }
    let deformation = mat_identity() + displacement_gradient[facet_owner[e]];
    let inverse = adjugate(deformation) * (1.0 / determinant_mat(deformation));
    let load = sum_loads(e, inverse);
    let normal = facet_normal[e];
    let turning = load.turning - normal * inner(load.turning, normal);
    facet_force[e] = load.force;
    facet_moment[e] = outer(normal, mat_vec(inverse, turning)) - outer(load.force, lever(e)) + load.aside;
}

fn sum_loads(e: u32, inverse: Mat) -> Load {
    let own = seat(e);
    let a = facet_owner[e];
    let pull = facet_pull[e];
    var load = Load();
#if friction
    load.force += facet_traction[e];
#endif
    let listed = facet_contact_count[e];
    for (var k = 0u; k < listed; k++) {
        let f = facet_contacts[k * params.facet_count + e];
        let pulled = facet_pull[f];
        if pull == 0.0 && pulled == 0.0 {
            continue;
        }
        let near = facing(own, f, listed_pair(a, f).range);
        if near.weight == 0.0 {
            continue;
        }
        let other = facet_normal[f];
        // The force is minus the derivatives of the energy by the distances along the two normals.
        load.force += own.normal * (pulled * near.weight) - other * (pull * near.weight);
#if !along_normals
        let along = inner(other, near.x) - facet_gap[e];
        let along_other = -inner(own.normal, near.x) - facet_gap[f];
        let by_weight = pull * along + facet_edge[e] + pulled * along_other + facet_edge[f];
        load.force -= near.x * (by_weight * near.by_distance);
        load.turning += near.x * (pulled * near.weight) - other * (by_weight * near.by_turn);
#endif
#if friction
        let rubbed = facet_traction[f] * (-near.weight * facet_spread[f]);
        load.force += rubbed;
        // From facet e to facet f, where the force acts.
        load.aside += outer(rubbed, mat_vec(inverse, near.x));
#endif
    }
    return load;
}
