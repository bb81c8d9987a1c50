// The shaders of `ours.rs`: a vertex's colour, interpolated in one of three ways. And those that read back what cannot be copied: depths, and samples.

struct Vertex {
    @location(0) position: vec4<f32>,
    @location(1) color: vec4<f32>,
}

struct Perspective {
    @builtin(position) position: vec4<f32>,
    @location(0) color: vec4<f32>,
}

struct Linear {
    @builtin(position) position: vec4<f32>,
    @location(0) @interpolate(linear) color: vec4<f32>,
}

struct Flat {
    @builtin(position) position: vec4<f32>,
    @location(0) @interpolate(flat, first) color: vec4<f32>,
}

@vertex
fn perspective_vertex(vertex: Vertex) -> Perspective {
    return Perspective(vertex.position, vertex.color);
}

@fragment
fn perspective_fragment(fragment: Perspective) -> @location(0) vec4<f32> {
    return fragment.color;
}

@vertex
fn linear_vertex(vertex: Vertex) -> Linear {
    return Linear(vertex.position, vertex.color);
}

@fragment
fn linear_fragment(fragment: Linear) -> @location(0) vec4<f32> {
    return fragment.color;
}

@vertex
fn flat_vertex(vertex: Vertex) -> Flat {
    return Flat(vertex.position, vertex.color);
}

@fragment
fn flat_fragment(fragment: Flat) -> @location(0) vec4<f32> {
    return fragment.color;
}

@group(0) @binding(0) var depth: texture_depth_2d;
@group(0) @binding(0) var sampled_depth: texture_depth_multisampled_2d;
@group(0) @binding(0) var sampled_color: texture_multisampled_2d<f32>;
@group(0) @binding(1) var<storage, read_write> bits: array<u32>;

@compute @workgroup_size(64)
fn read_depth(@builtin(global_invocation_id) at: vec3<u32>) {
    let side = textureDimensions(depth).x;
    bits[at.y * side + at.x] = bitcast<u32>(textureLoad(depth, at.xy, 0));
}

@compute @workgroup_size(64)
fn read_sampled_depth(@builtin(global_invocation_id) at: vec3<u32>) {
    let side = textureDimensions(sampled_depth).x;
    bits[(at.z * side + at.y) * side + at.x] = bitcast<u32>(textureLoad(sampled_depth, at.xy, at.z));
}

@compute @workgroup_size(64)
fn read_sampled_color(@builtin(global_invocation_id) at: vec3<u32>) {
    let side = textureDimensions(sampled_color).x;
    bits[(at.z * side + at.y) * side + at.x] = pack4x8unorm(textureLoad(sampled_color, at.xy, at.z));
}
