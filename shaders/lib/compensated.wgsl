// Adds an increment to a sum and keeps the rounding error. Twin: compensated_add in src/pass/write.rs
//
// Drivers' compilers simplify (sum + y) - sum to y, which loses the error. An exclusive or with `params.zero`, which is
// always 0 but not known to the compiler, hides the sum from them.
#import params

struct Compensated {
    sum: Vec,
    carry: Vec,
}

fn compensated_add(sum: Vec, carry: Vec, increment: Vec) -> Compensated {
    let corrected = increment - carry;
    let total = hidden(sum + corrected, params.zero);
    let added = hidden(total - sum, params.zero);
    return Compensated(total, added - corrected);
}
