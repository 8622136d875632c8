// A temperature that stays. Twin: src/material/isothermal.rs
#import params

fn rise_isothermal(body: Body, work: real) -> real {
    return 0.0;
}
