//! Text of `#import potential`: the potentials of one scene and no others. One is called directly, several meet in a
//! switch over the law of the pair of bodies.

use crate::contact::Potential;

pub(super) fn text(potentials: &[Potential]) -> String {
    let Some((&last, others)) = potentials.split_last() else { return String::new() };
    let call = |law: Potential| format!("return potential_{}(q, pair.exponent);", law.name());
    let mut text: String = potentials.iter().map(|law| law.source()).collect();
    text += "\n// phi, -phi' and phi'' at q = r/range.\nfn potential(pair: ContactPair, q: real) -> vec3<real> {\n";
    // Some case must be the default.
    if others.is_empty() {
        return text + &format!("    {}\n}}\n", call(last));
    }
    let cases: String = others.iter().map(|&law| format!("        case {}u: {{ {} }}\n", law as u32, call(law))).collect();
    text + &format!("    switch pair.law {{\n{cases}        default: {{ {} }}\n    }}\n}}\n", call(last))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_potential_is_called_directly_and_several_meet_in_a_switch() {
        let one = text(&[Potential::Barrier]);
        assert!(one.contains("return potential_barrier(q, pair.exponent);") && !one.contains("switch"), "{one}");
        let two = text(&[Potential::Power, Potential::Repulsive]);
        assert!(two.contains("case 1u: { return potential_power(q, pair.exponent); }"), "{two}");
        assert!(two.contains("default: { return potential_repulsive(q, pair.exponent); }"), "{two}");
        assert!(!two.contains("barrier"));
    }
}
