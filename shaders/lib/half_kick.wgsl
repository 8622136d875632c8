// Half a step's change of a free obstacle's velocity. The pass declares `clock`, `movers` and `obstacle_force`.
// Twin: half_kick in src/pass/move_obstacles.rs
#import params

fn half_kick(k: u32) -> Vec {
    let pull = vec_of(params.body_force_x, params.body_force_y, params.body_force_z);
    return (obstacle_force[k] * movers[k].inverse_mass + pull) * (0.5 * clock.step);
}
