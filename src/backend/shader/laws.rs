//! Shader text that the laws of a scene ask for: their structures of numbers, and the twins of the functions of
//! `src/material/mod.rs` over these laws and no others. A single law is called directly; several are called from a switch
//! over the number of the law that the body holds.

use crate::material::{Law, Role};

/// A law's text: its structure of numbers, how it is read from a body, and its file.
pub(super) fn text_of(law: Law) -> String {
    let declared = law.declaration();
    if declared.numbers.is_empty() {
        return declared.source.into();
    }
    let members: String = declared.numbers.iter().map(|number| format!("    {}: real,\n", number.key)).collect();
    let places = (0..declared.numbers.len()).map(|k| format!("body.numbers[{}]", declared.role.first() + k));
    let (structure, word) = (declared.structure, declared.word);
    format!(
        "#import params\n\nstruct {structure} {{\n{members}}}\n\nfn {word}_of(body: Body) -> {structure} {{\n    \
         return {structure}({});\n}}\n\n{}",
        places.collect::<Vec<_>>().join(", "),
        declared.source
    )
}

/// A function over the laws of a role, `name_law` in each law's file.
struct OverRole {
    role: Role,
    name: &'static str,
    parameter: &'static str,
    result: &'static str,
    /// Imported beside the laws.
    import: &'static str,
    /// What bodies without such a law get.
    none: &'static str,
}

const PRESSURES: OverRole = OverRole {
    role: Role::Pressure,
    name: "kirchhoff",
    parameter: "volume_change: real",
    result: "real",
    import: "params",
    none: "0.0",
};
const STRENGTHS: OverRole = OverRole {
    role: Role::Strength,
    name: "flow",
    parameter: "at: Point",
    result: "Flow",
    import: "flow",
    none: "Flow(0.0, 0.0, 0.0)",
};
const HEATS: OverRole =
    OverRole { role: Role::Heat, name: "rise", parameter: "work: real", result: "real", import: "params", none: "0.0" };

/// Text of `#import pressures`, `strengths` or `heats`.
pub(super) fn over_role(import: &str, laws: &[Law]) -> Option<String> {
    let function = match import {
        "pressures" => PRESSURES,
        "strengths" => STRENGTHS,
        "heats" => HEATS,
        _ => return None,
    };
    let asked = |law: &Law| law.role() == function.role && (function.role != Role::Strength || law.yields());
    let laws: Vec<Law> = laws.iter().copied().filter(asked).collect();
    let imports: String = laws.iter().map(|law| format!("#import {}\n", law.word())).collect();
    let OverRole { name, parameter, result, none, .. } = function;
    let argument = parameter.split(':').next().unwrap_or_default();
    let call = |law: Law| format!("return {name}_{}(body, {argument});", law.word());
    let body = match laws[..] {
        [] => format!("    return {none};\n"),
        // A body that does not yield never asks for a flow stress, nor a whole law for a pressure, so a single law needs no
        // switch. A body without a heat does ask for the rise of its temperature, which is 0.
        [only] if function.role != Role::Heat => format!("    {}\n", call(only)),
        _ => {
            let role = function.role.word();
            let cases: String =
                laws.iter().map(|&law| format!("        case {}u: {{ {} }}\n", law.number(), call(law))).collect();
            format!("    switch body.{role} {{\n{cases}        default: {{ return {none}; }}\n    }}\n")
        }
    };
    Some(format!("#import {}\n{imports}\nfn {name}(body: Body, {parameter}) -> {result} {{\n{body}}}\n", function.import))
}

/// A function at finite strain that a law may give, `name_law` in the law's file.
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

/// What answers a deformation: a law that is whole, or the laws of a material's roles together.
struct Answer {
    /// What the body holds for its whole law.
    number: u32,
    word: &'static str,
    memory: bool,
}

/// Text of `#import laws`.
pub(super) fn text(laws: &[Law]) -> String {
    let whole = laws.iter().filter(|law| law.role() == Role::Whole);
    let mut answers: Vec<Answer> =
        whole.map(|law| Answer { number: law.number(), word: law.word(), memory: law.has_memory() }).collect();
    if laws.iter().any(|law| matches!(law.role(), Role::Pressure | Role::Strength)) {
        answers.push(Answer { number: 0, word: "of_roles", memory: laws.iter().any(|law| law.yields()) });
    }
    let mut text: String = answers.iter().map(|answer| format!("#import {}\n", answer.word)).collect();
    let memory = answers.iter().any(|answer| answer.memory);
    if memory {
        text += "#import memory\n";
    }
    for function in FUNCTIONS.iter().filter(|function| memory || function.without_memory.is_none()) {
        text += &format!("\nfn {}({}) -> {} {{\n", function.name, function.parameters, function.result);
        text += &body(function, &answers);
        text += "}\n";
    }
    text
}

/// Text of `#import stiffening`. Twin: `stiffening` in src/material/mod.rs
pub(super) fn stiffening(laws: &[Law]) -> String {
    let has = |law: Law| laws.contains(&law);
    let mut text = String::from("#import stiffness\n");
    let mut cases = String::new();
    let by_volume = |mean: &str| format!("by_volume(body, h, {mean}change), {mean}denser(change)))");
    if has(Law::StVenantKirchhoff) {
        cases += &format!("        case {}u: {{ return by_stretch(h); }}\n", Law::StVenantKirchhoff.number());
    }
    let elastic = [Law::NeoHookean, Law::Maxwell].into_iter().filter(|&law| has(law)).map(|law| format!("{}u", law.number()));
    let elastic = elastic.collect::<Vec<_>>().join(", ");
    if !elastic.is_empty() {
        text += "#import volumetric_stress\n";
        let answer = by_volume("volumetric_stress(body.bulk_modulus, ");
        cases += &format!("        case {elastic}: {{ return {answer}; }}\n");
    }
    if laws.iter().any(|law| law.role() == Role::Pressure) {
        text += "#import pressures\n";
        cases += &format!("        case 0u: {{ return {}; }}\n", by_volume("kirchhoff(body, "));
    }
    text + "\nfn stiffening(body: Body, h: Mat) -> real {\n    let change = volume_change(h);\n    switch body.whole {\n"
        + &cases
        + "        default: { return 1.0; }\n    }\n}\n"
}

fn body(function: &Function, answers: &[Answer]) -> String {
    let call = |answer: &Answer| match function.without_memory {
        Some(value) if !answer.memory => format!("return {value};"),
        _ => format!("return {}_{}({});", function.name, answer.word, function.arguments),
    };
    // WGSL asks for a default: the last answer is it.
    let Some((last, others)) = answers.split_last() else { return String::new() };
    if others.is_empty() {
        return format!("    {}\n", call(last));
    }
    let cases: String =
        others.iter().map(|answer| format!("        case {}u: {{ {} }}\n", answer.number, call(answer))).collect();
    format!("    switch body.whole {{\n{cases}        default: {{ {} }}\n    }}\n", call(last))
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
    fn several_laws_meet_in_a_switch_over_what_the_body_has() {
        let text = text(&[Law::StVenantKirchhoff, Law::Maxwell]);
        assert!(text.contains(&format!("case {}u: {{ return first_piola_st_venant", Law::StVenantKirchhoff.number())), "{text}");
        assert!(text.contains("default: { return relax_maxwell(body, h, memory, step); }"), "{text}");
        let without = format!("case {}u: {{ return memory; }}", Law::StVenantKirchhoff.number());
        assert!(text.contains(&without), "{text}");
    }

    #[test]
    fn numbers_are_read_from_the_places_of_their_role() {
        let text = text_of(Law::J2);
        assert!(text.contains("struct J2 {\n    yield_stress: real,"), "{text}");
        assert!(text.contains("return J2(body.numbers[8], body.numbers[9], body.numbers[10]);"), "{text}");
    }

    #[test]
    fn a_strength_that_does_not_give_way_is_not_asked() {
        let text = over_role("strengths", &[Law::Linear, Law::Elastic, Law::J2]).unwrap();
        assert!(text.contains("return flow_j2(body, at);") && !text.contains("elastic"), "{text}");
    }
}
