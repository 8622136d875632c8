// Linear equation of state: the mean Kirchhoff stress is K e, e = J - 1. Twin: src/material/linear.rs
#import params

fn kirchhoff_linear(body: Body, volume_change: real) -> real {
    return body.bulk_modulus * volume_change;
}
