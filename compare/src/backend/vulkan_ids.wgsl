// The number of the triangle that each pixel shows.
enable primitive_index;

struct Uniforms {
    clip_from_world: mat4x4<f32>,
}

@group(0) @binding(0) var<uniform> uniforms: Uniforms;

@vertex
fn lit_vertex(@location(0) position: vec3<f32>) -> @builtin(position) vec4<f32> {
    return uniforms.clip_from_world * vec4(position, 1.0);
}

@fragment
fn id_fragment(@builtin(primitive_index) triangle: u32) -> @location(0) u32 {
    return triangle;
}
