// Spheres as squares that face the eye: each fragment finds the surface of its sphere, its depth and
// its light. The twin of `shade` and `cover` in src/output/splat.rs; lengths are in samples.

struct Frame {
    size: vec2<f32>,
    radius: f32,
    relief: f32,
    // To the light; w is unused.
    light: vec4<f32>,
    ambient: f32,
    diffuse: f32,
    // The least and the greatest z of any sphere.
    far: f32,
    near: f32,
}

@group(0) @binding(0) var<uniform> frame: Frame;

struct Impostor {
    @builtin(position) position: vec4<f32>,
    @location(0) @interpolate(flat) center: vec3<f32>,
    @location(1) @interpolate(flat) colour: vec3<f32>,
}

struct Surface {
    @location(0) colour: vec4<f32>,
    @builtin(frag_depth) depth: f32,
}

@vertex
fn vertex(
    @builtin(vertex_index) corner: u32,
    @location(0) center: vec3<f32>,
    @location(1) colour: vec3<f32>,
) -> Impostor {
    let side = vec2<f32>(f32(corner & 1u), f32(corner >> 1u)) * 2.0 - 1.0;
    // A sample more than the radius: the edge is decided in the fragment, not by rounding here.
    let place = (center.xy + side * (frame.radius + 1.0)) / frame.size;
    return Impostor(vec4<f32>(place.x * 2.0 - 1.0, 1.0 - place.y * 2.0, 0.5, 1.0), center, colour);
}

@fragment
fn fragment(impostor: Impostor) -> Surface {
    let offset = impostor.position.xy - impostor.center.xy;
    let rest = frame.radius * frame.radius - dot(offset, offset);
    if rest < 0.0 {
        discard;
    }
    let height = sqrt(rest);
    let normal = vec3<f32>(offset.x, -offset.y, height) / frame.radius;
    let facing = max(dot(normal, frame.light.xyz), 0.0);
    let light = 1.0 + frame.relief * (frame.ambient + frame.diffuse * facing - 1.0);
    let depth = (frame.near - impostor.center.z - height) / (frame.near - frame.far);
    return Surface(vec4<f32>(impostor.colour * light, 1.0), depth);
}
