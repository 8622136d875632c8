// Heat of plastic work that has no time to flow away. Twin: src/material/adiabatic.rs
#import params

// By how much plastic work, per reference volume, raises the temperature.
fn rise_adiabatic(body: Body, work: real) -> real {
    let own = adiabatic_of(body);
    return own.work_fraction * work / (body.density * own.specific_heat);
}
