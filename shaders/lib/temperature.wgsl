// Temperature of a particle, 0 where no law heats it.

#if heated
@group(0) @binding(_) var<storage, read_write> temperature: array<real>;

fn temperature_of(a: u32) -> real {
    return temperature[a];
}

fn set_temperature(a: u32, warm: real) {
    temperature[a] = warm;
}
#else
fn temperature_of(a: u32) -> real {
    return 0.0;
}

fn set_temperature(a: u32, warm: real) {}
#endif
