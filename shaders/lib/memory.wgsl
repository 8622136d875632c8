// What a law remembers: the inelastic strain C_i - 1, and the equivalent plastic strain. Twin: Memory in
// src/material/mod.rs
#import tensor

struct Memory {
    strain: Sym,
    plastic: real,
}
