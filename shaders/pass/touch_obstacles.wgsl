// Force of the rigid obstacle that a facet is deepest in, and friction. Twin: src/pass/touch_obstacles.rs
#import params
#import body_index
#import facet_lever
#import obstacle
#import stick if friction

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> facet_displacement: array<Vec>;
@group(0) @binding(_) var<storage, read> facet_area: array<real>;
@group(0) @binding(_) var<storage, read> obstacles: array<Obstacle>;
@group(0) @binding(_) var<storage, read> obstacle_pairs: array<FacetPair>;
@group(0) @binding(_) var<storage, read> obstacle_displacement: array<Vec>;
@group(0) @binding(_) var<storage, read_write> facet_obstacle: array<u32>;
@group(0) @binding(_) var<storage, read_write> facet_load: array<Vec>;
@group(0) @binding(_) var<storage, read_write> facet_force: array<Vec>;
@group(0) @binding(_) var<storage, read_write> facet_moment: array<Mat>;
@group(0) @binding(_) var<storage, read_write> facet_pressure: array<real>;
@group(0) @binding(_) var<storage, read_write> facet_energy: array<real>;
#if friction
@group(0) @binding(_) var<storage, read> facet_move: array<Vec>;
@group(0) @binding(_) var<storage, read> obstacle_move: array<Vec>;
@group(0) @binding(_) var<storage, read_write> facet_obstacle_slip: array<Vec>;
@group(0) @binding(_) var<storage, read_write> facet_heat: array<real>;
#endif

// What an obstacle does to a facet.
struct Touch {
    load: Vec,
    pressure: real,
    energy: real,
    slip: Vec,
    heat: real,
}

fn of_facet(e: u32) {
    // Index of the obstacle, plus 1; 0 for none.
    var found = 0u;
    var nearest = Nearest(0.0, Vec());
    for (var k = 0u; k < params.obstacle_count; k++) {
        if pair_of(k, e).stiffness == 0.0 {
            continue;
        }
        let reference = facet_reference_position[e] - obstacle_point(obstacles[k]);
        let near = obstacle_distance(obstacles[k], reference + (facet_displacement[e] - obstacle_displacement[k]));
        if near.gap < nearest.gap {
            found = k + 1u;
            nearest = near;
        }
    }
    var touch = Touch();
    if found > 0u {
        touch = touch_of(e, found - 1u, nearest);
    }
#if friction
    facet_obstacle_slip[e] = touch.slip;
#if gap
    facet_heat[e] += touch.heat;
#else
    facet_heat[e] = touch.heat;
#endif
#endif
    // The facet was out of touch before and still is: there is no force to add, and no earlier one to set to zero.
    if found == 0u && facet_obstacle[e] == 0u {
        return;
    }
    facet_obstacle[e] = found;
    facet_load[e] = touch.load;
    let moment = outer(touch.load, lever(e)) * -1.0;
#if gap
    facet_force[e] += touch.load;
    facet_moment[e] += moment;
    facet_pressure[e] += touch.pressure;
    facet_energy[e] += touch.energy;
#else
    facet_force[e] = touch.load;
    facet_moment[e] = moment;
    facet_pressure[e] = touch.pressure;
    facet_energy[e] = touch.energy;
#endif
}

fn obstacle_point(obstacle: Obstacle) -> Vec {
    return vec_of(obstacle.point_x, obstacle.point_y, obstacle.point_z);
}

fn pair_of(k: u32, e: u32) -> FacetPair {
    return obstacle_pairs[k * params.body_count + body_index(facet_owner[e])];
}

fn touch_of(e: u32, k: u32, near: Nearest) -> Touch {
    let pair = pair_of(k, e);
    let stiffness = pair.stiffness * facet_area[e];
    let force = -stiffness * near.gap;
    var touch = Touch(near.normal * force, force / facet_area[e], -0.5 * force * near.gap, Vec(), 0.0);
#if friction
    if pair.friction > 0.0 {
        let grown = facet_obstacle_slip[e] + facet_move[e] - obstacle_move[k];
        let along = grown - near.normal * inner(grown, near.normal);
        let stuck = stick(facet_obstacle_slip[e], along, stiffness, pair.friction * force);
        touch.slip = stuck.slip;
        touch.heat = stuck.heat;
        touch.load += stuck.slip * -stiffness;
        touch.energy += 0.5 * stiffness * inner(stuck.slip, stuck.slip);
    }
#endif
    return touch;
}
