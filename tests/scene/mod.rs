//! What a scene says of its bodies before it runs: masses.

mod mass;
