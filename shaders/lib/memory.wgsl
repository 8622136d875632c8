// What a particle of finite strain remembers: the inelastic strain C_i - 1, the equivalent plastic strain and the
// temperature. Twin: Memory in src/material/point.rs
#import tensor

struct Memory {
    strain: Sym,
    plastic: real,
    temperature: real,
}
