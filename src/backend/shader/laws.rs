//! Text of `#import laws`: the functions of `src/material/mod.rs` over the laws of one scene and no others. One
//! law is called directly, several meet in a switch over the law of the body.

use crate::material::Law;

/// A function that a law may give, `name_law` in the law's file.
struct Function {
    name: &'static str,
    parameters: &'static str,
    arguments: &'static str,
    result: &'static str,
    /// What it is for a law without memory; the laws that remember alone have a function for it.
    without_memory: Option<&'static str>,
}

const FUNCTIONS: [Function; 3] = [
    Function {
        name: "first_piola",
        parameters: "body: Body, h: Mat, memory: Sym",
        arguments: "body, h, memory",
        result: "Mat",
        without_memory: None,
    },
    Function {
        name: "relax",
        parameters: "body: Body, h: Mat, memory: Memory, step: real",
        arguments: "body, h, memory, step",
        result: "Memory",
        without_memory: Some("memory"),
    },
    Function {
        name: "dissipated",
        parameters: "body: Body, old_h: Mat, old_memory: Sym, h: Mat, memory: Sym",
        arguments: "body, old_h, old_memory, h, memory",
        result: "real",
        without_memory: Some("0.0"),
    },
];

pub(super) fn text(laws: &[Law]) -> String {
    let laws: Vec<Law> = laws.iter().copied().filter(|law| law.is_finite_strain()).collect();
    let mut text: String = laws.iter().map(|law| format!("#import {}\n", law.word())).collect();
    let memory = laws.iter().any(|law| law.has_memory());
    if memory {
        text += "#import memory\n";
    }
    for function in FUNCTIONS.iter().filter(|function| memory || function.without_memory.is_none()) {
        text += &format!("\nfn {}({}) -> {} {{\n", function.name, function.parameters, function.result);
        text += &body(function, &laws);
        text += "}\n";
    }
    text
}

fn body(function: &Function, laws: &[Law]) -> String {
    let call = |law: Law| match function.without_memory {
        Some(value) if !law.has_memory() => format!("return {value};"),
        _ => format!("return {}_{}({});", function.name, law.word(), function.arguments),
    };
    // Some case must be the default.
    let Some((&last, others)) = laws.split_last() else { return String::new() };
    if others.is_empty() {
        return format!("    {}\n", call(last));
    }
    let cases: String = others.iter().map(|&law| format!("        case {}u: {{ {} }}\n", law as u32, call(law))).collect();
    format!("    switch body.law {{\n{cases}        default: {{ {} }}\n    }}\n", call(last))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_law_is_called_directly() {
        let text = text(&[Law::NeoHookean]);
        assert!(text.starts_with("#import neo_hookean\n") && text.contains("return first_piola_neo_hookean(body, h, memory);"));
        assert!(!text.contains("switch") && !text.contains("relax") && !text.contains("maxwell"), "{text}");
    }

    #[test]
    fn several_laws_meet_in_a_switch() {
        let text = text(&[Law::StVenantKirchhoff, Law::Maxwell]);
        assert!(text.contains("case 2u: { return first_piola_st_venant_kirchhoff(body, h, memory); }"), "{text}");
        assert!(text.contains("default: { return first_piola_maxwell(body, h, memory); }"), "{text}");
        assert!(text.contains("case 2u: { return memory; }") && text.contains("case 2u: { return 0.0; }"), "{text}");
    }
}
