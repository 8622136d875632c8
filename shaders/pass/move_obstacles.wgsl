// Moves rigid obstacles to the end of the step: along their course, or, where they are free, as their mass and the force
// of the bodies ask for. Twin: src/pass/move_obstacles.rs
#import half_kick
#import course_integral

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> movers: array<Mover>;
@group(0) @binding(_) var<storage, read> obstacle_force: array<Vec>;
@group(0) @binding(_) var<storage, read_write> obstacle_displacement: array<Vec>;
@group(0) @binding(_) var<storage, read_write> obstacle_velocity: array<Vec>;
#if friction
@group(0) @binding(_) var<storage, read_write> obstacle_move: array<Vec>;
#endif

@compute @workgroup_size(256)
fn main(@builtin(local_invocation_index) local: u32) {
    if clock.running == 0u {
        return;
    }
    for (var k = local; k < params.obstacle_count; k += 256u) {
        let before = obstacle_displacement[k];
        if movers[k].inverse_mass > 0.0 {
            let velocity = obstacle_velocity[k] + half_kick(k);
            obstacle_velocity[k] = velocity;
            obstacle_displacement[k] = before + velocity * clock.step;
        } else {
            prescribe(k);
        }
#if friction
        obstacle_move[k] = obstacle_displacement[k] - before;
#endif
    }
}

// Velocity, and the displacement since time 0, at the end of the step; in a descent at the end of the load step.
fn prescribe(k: u32) {
    var velocity = Vec();
    var moved = Vec();
#if constraints
    if movers[k].condition != 0u {
        let condition = constraints[movers[k].condition - 1u];
#if quasi_static
        let time = clock.start + clock.duration;
#else
        let time = clock.start + (clock.elapsed + clock.step);
#endif
        let vector = vec_of(condition.x, condition.y, condition.z);
        velocity = vector * course_factor(condition, time);
        moved = vector * course_integral(condition, 0.0, time);
    }
#endif
    obstacle_velocity[k] = velocity;
    obstacle_displacement[k] = moved;
}
