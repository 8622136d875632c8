//! Which formulation bodies have that name none.

use super::file::{BodyTable, File};
use super::material::MaterialTable;
use crate::material::Role;
use crate::method::Formulation;

impl File {
    /// Gives a formulation whose `kind` was not typed the Total Lagrangian one, where the laws of all its bodies serve there. A
    /// solid in the Eulerian formulation breaks for numerical reasons when it is pulled, so that one has to be asked for. What is
    /// left, fluids and Hooke's law in rates, has the Eulerian formulation alone. `typed` says whether the plain formulation or
    /// the one of a name has the key.
    pub(super) fn settle_kinds(&mut self, typed: impl Fn(Option<&str>) -> bool) {
        let File { body, material, formulation, formulations, .. } = self;
        let serves = |body: &BodyTable| material.get(&body.material).is_some_and(MaterialTable::serves_reference);
        let settled = |name: Option<&str>| {
            let mut own = body.iter().filter(|body| body.formulation.as_deref() == name).peekable();
            own.peek().is_some() && !typed(name) && own.all(serves)
        };
        if settled(None) {
            formulation.kind = Formulation::TotalLagrangian;
        }
        for (_, named) in formulations.iter_mut().filter(|(name, _)| settled(Some(name.as_str()))) {
            named.kind = Formulation::TotalLagrangian;
        }
    }
}

impl MaterialTable {
    /// Whether the law is one of the Total Lagrangian formulation.
    fn serves_reference(&self) -> bool {
        self.named().is_some_and(|law| law.role() == Role::Whole) || self.yields()
    }
}

#[cfg(test)]
mod tests {
    use crate::method::Formulation::{Eulerian, TotalLagrangian};
    use crate::scene::Scene;

    /// The formulation of the first group of a scene with this law and these lines under `[formulation]`.
    fn kind(law: &str, lines: &str, variant: Option<&str>) -> crate::method::Formulation {
        let text = format!(
            "title = 't'\ndimension = 2\nspacing = 1.0\nduration = 1.0\n[[body]]\nname = 'b'\nmaterial = 'm'\n\
             shape = {{ block = {{ min = [0, 0], max = [6, 6] }} }}\n[material.m]\ndensity = 1.0\nyoungs_modulus = 1.0\n\
             poisson_ratio = 0.3\n{law}\n[formulation]\n{lines}\n[variant.rates]\nformulation.kind = 'eulerian'\n"
        );
        let scene = Scene::parse(&text, "s", variant, &[]).unwrap_or_else(|error| panic!("{error}"));
        scene.groups()[0].method.formulation
    }

    #[test]
    fn what_is_not_typed_is_total_lagrangian_where_the_law_allows() {
        let j2 = "law = 'j2'\nyield_stress = 0.1";
        assert_eq!(kind(j2, "viscosity = { alpha = 0.1 }", None), TotalLagrangian);
        assert_eq!(kind("law = 'neo_hookean'", "", None), TotalLagrangian);
        assert_eq!(kind("", "", None), Eulerian);
        assert_eq!(kind(j2, "kind = 'eulerian'", None), Eulerian);
        assert_eq!(kind(j2, "", Some("rates")), Eulerian);
    }

    #[test]
    fn a_named_formulation_has_a_kind_of_its_own() {
        let text = "title = 't'\ndimension = 2\nspacing = 1.0\nduration = 1.0\n\
             [[body]]\nname = 'a'\nmaterial = 'm'\nshape = { block = { min = [0, 0], max = [6, 6] } }\n\
             [[body]]\nname = 'b'\nmaterial = 'n'\nformulation = 'soft'\nshape = { block = { min = [9, 0], max = [15, 6] } }\n\
             [material.m]\ndensity = 1.0\nyoungs_modulus = 1.0\npoisson_ratio = 0.3\n\
             [material.n]\nlaw = 'neo_hookean'\ndensity = 1.0\nyoungs_modulus = 1.0\npoisson_ratio = 0.3\n\
             [formulation.soft]\nsmoothing_length = 1.3\n";
        let scene = Scene::parse(text, "s", None, &[]).unwrap_or_else(|error| panic!("{error}"));
        let kinds: Vec<_> = scene.groups().iter().map(|group| group.method.formulation).collect();
        assert_eq!(kinds, [Eulerian, TotalLagrangian]);
    }
}
