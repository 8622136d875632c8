use super::*;

fn sample<S: Space>(seed: u64) -> S::Mat {
    let mut m = S::mat_identity();
    let mut state = seed;
    for i in 0..S::DIMENSION {
        for j in 0..S::DIMENSION {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            m[S::mat_index(i, j)] += S::Real::of(((state >> 33) as f64 / 2f64.powi(31) - 0.5) * 0.6);
        }
    }
    m
}

fn inverse_holds<S: Space>() {
    for seed in 1..50 {
        let m = sample::<S>(seed);
        let product = S::mat_mat(m, S::adjugate(m)) * (S::Real::of(1.0) / S::determinant(m));
        let error = product - S::mat_identity();
        for k in 0..S::Mat::LENGTH {
            assert!(error[k].f64().abs() < 1e-13, "{product:?}");
        }
    }
}

#[test]
fn adjugate_over_determinant_is_the_inverse() {
    inverse_holds::<Line<f64>>();
    inverse_holds::<Plane<f64>>();
    inverse_holds::<Solid<f64>>();
}

#[test]
fn symmetric_and_skew_parts_add_up() {
    let m = sample::<Solid<f64>>(7);
    let sum = Solid::<f64>::mat_of_sym(Solid::<f64>::sym_part(m)) + Solid::<f64>::skew_part(m);
    assert_eq!((sum - m).0.map(|x| x.abs() < 1e-15), [true; 12]);
}

#[test]
fn outer_product_acts_as_its_definition() {
    type S = Solid<f64>;
    let (a, b, v) = (S::vec_from([1.0, 2.0, 3.0]), S::vec_from([-1.0, 0.5, 4.0]), S::vec_from([0.3, 0.7, -2.0]));
    let seen = S::mat_vec(S::outer(a, b), v);
    assert_eq!(S::vec_to(seen), S::vec_to(a * S::inner(b, v)));
}
