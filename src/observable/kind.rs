//! What an observable is: its kind, and what a scene makes of it.

use super::moment::Moment;
use super::table::Table;
use crate::fields::Field;
use crate::scene::file::Observe;

/// One kind of observable.
pub struct ObservableKind {
    /// Word in a scene.
    pub word: &'static str,
    pub about: &'static str,
    /// Keys of `[observe.NAME]` that it cannot do without; one of those that `|` parts.
    pub needs: &'static [&'static str],
    /// Fields that it reads in the Eulerian formulation; those that a run has no counterpart of are refused.
    pub fields: &'static [Field],
    pub value: Value,
}

/// How the number is found.
pub enum Value {
    Series(fn(&Moment, &Observer) -> f64),
    Result(fn(&Table, &Observe) -> Result<f64, String>),
    Profile,
    /// Two series as the path of a point.
    Trace,
}

/// An observable of a scene, its selection resolved once.
pub struct Observer {
    pub name: String,
    pub typed: Observe,
    pub kind: &'static ObservableKind,
    /// Numbers of the particles that it is taken over.
    pub particles: Vec<usize>,
    /// Component along which it is taken.
    pub axis: Option<usize>,
}
