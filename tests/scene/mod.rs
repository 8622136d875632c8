//! What a scene says of its bodies before it runs: masses, thin parts, held ends, times and speeds, and bodies with nothing between them.

mod held;
mod layers;
mod mass;
mod slips;
mod strangers;
mod waves;
