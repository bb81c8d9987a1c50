// Textures looked up one place at a time, a place a pixel.

struct Place {
    at: vec3<f32>,
    extra: f32,
    right: vec3<f32>,
    layer: f32,
    down: vec3<f32>,
    padding: f32,
}

const SIDE = 256u;

@group(0) @binding(0) var<storage, read> places: array<Place>;
@group(0) @binding(1) var looks: sampler;
@group(0) @binding(1) var compares: sampler_comparison;
@group(0) @binding(2) var flat_texture: texture_2d<f32>;
@group(0) @binding(2) var array_texture: texture_2d_array<f32>;
@group(0) @binding(2) var cube_texture: texture_cube<f32>;
@group(0) @binding(2) var volume_texture: texture_3d<f32>;
@group(0) @binding(2) var flat_depth: texture_depth_2d;
@group(0) @binding(2) var array_depth: texture_depth_2d_array;
@group(0) @binding(2) var cube_depth: texture_depth_cube;

@vertex
fn whole_picture(@builtin(vertex_index) k: u32) -> @builtin(position) vec4<f32> {
    return vec4(f32(k & 1u) * 4.0 - 1.0, f32(k >> 1u) * 4.0 - 1.0, 0.5, 1.0);
}

fn place(pixel: vec4<f32>) -> Place {
    return places[u32(pixel.y) * SIDE + u32(pixel.x)];
}

@fragment
fn flat_level(@builtin(position) pixel: vec4<f32>) -> @location(0) vec4<f32> {
    let p = place(pixel);
    return textureSampleLevel(flat_texture, looks, p.at.xy, p.extra);
}

@fragment
fn flat_gradient(@builtin(position) pixel: vec4<f32>) -> @location(0) vec4<f32> {
    let p = place(pixel);
    return textureSampleGrad(flat_texture, looks, p.at.xy, p.right.xy, p.down.xy);
}

@fragment
fn flat_compare(@builtin(position) pixel: vec4<f32>) -> @location(0) vec4<f32> {
    let p = place(pixel);
    return vec4(textureSampleCompareLevel(flat_depth, compares, p.at.xy, p.extra));
}

@fragment
fn array_level(@builtin(position) pixel: vec4<f32>) -> @location(0) vec4<f32> {
    let p = place(pixel);
    return textureSampleLevel(array_texture, looks, p.at.xy, i32(p.layer), p.extra);
}

@fragment
fn array_gradient(@builtin(position) pixel: vec4<f32>) -> @location(0) vec4<f32> {
    let p = place(pixel);
    return textureSampleGrad(array_texture, looks, p.at.xy, i32(p.layer), p.right.xy, p.down.xy);
}

@fragment
fn array_compare(@builtin(position) pixel: vec4<f32>) -> @location(0) vec4<f32> {
    let p = place(pixel);
    return vec4(textureSampleCompareLevel(array_depth, compares, p.at.xy, i32(p.layer), p.extra));
}

@fragment
fn cube_level(@builtin(position) pixel: vec4<f32>) -> @location(0) vec4<f32> {
    let p = place(pixel);
    return textureSampleLevel(cube_texture, looks, p.at, p.extra);
}

@fragment
fn cube_gradient(@builtin(position) pixel: vec4<f32>) -> @location(0) vec4<f32> {
    let p = place(pixel);
    return textureSampleGrad(cube_texture, looks, p.at, p.right, p.down);
}

@fragment
fn cube_compare(@builtin(position) pixel: vec4<f32>) -> @location(0) vec4<f32> {
    let p = place(pixel);
    return vec4(textureSampleCompareLevel(cube_depth, compares, p.at, p.extra));
}

@fragment
fn volume_level(@builtin(position) pixel: vec4<f32>) -> @location(0) vec4<f32> {
    let p = place(pixel);
    return textureSampleLevel(volume_texture, looks, p.at, p.extra);
}

@fragment
fn volume_gradient(@builtin(position) pixel: vec4<f32>) -> @location(0) vec4<f32> {
    let p = place(pixel);
    return textureSampleGrad(volume_texture, looks, p.at, p.right, p.down);
}

// And textures on triangles: where they are looked up is a varying, and the level of detail follows from it.

struct Surface {
    @builtin(position) position: vec4<f32>,
    @location(0) uv: vec2<f32>,
}

@vertex
fn surface(@location(0) position: vec4<f32>, @location(1) color: vec4<f32>) -> Surface {
    return Surface(position, color.xy);
}

@fragment
fn on_surface(fragment: Surface) -> @location(0) vec4<f32> {
    return textureSample(flat_texture, looks, fragment.uv);
}
