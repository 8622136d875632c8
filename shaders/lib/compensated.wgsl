// Sum that hands back what rounding dropped. Twin: compensated_add in src/pass/mod.rs
//
// Drivers simplify (sum + y) - sum to y; a sum hidden behind an exclusive or with a zero that they do not
// know, they cannot.
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
