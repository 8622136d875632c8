// Fuller's zones: (4.2), and what a particle is to its surface. Twin: src/contact/zones.rs
#import tensor

const SURFACE: u32 = 1u;
const CORNER: u32 = 2u;

// Size of the force on the intruder at r/R < 1 along the normal.
fn penalty(q: real) -> real {
    let inverse = 1.0 / max(q, 1e-6);
#if zones_printed
    return inverse + 1.0;
#else
    return inverse - 1.0;
#endif
}

// Whether a place beside the owner lies in the zone with this normal.
fn in_zone(place: Vec, normal: Vec, half: real) -> bool {
    let along = inner(place, normal);
    let across = place - normal * along;
    return abs(along) < half && inner(across, across) < half * half;
}
