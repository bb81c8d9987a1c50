struct Uniforms {
    clip_from_world: mat4x4<f32>,
    eye: vec3<f32>,
    ambient: f32,
    light: vec3<f32>,
    specular: f32,
    albedo: vec3<f32>,
}

@group(0) @binding(0) var<uniform> uniforms: Uniforms;

struct Colored {
    @builtin(position) position: vec4<f32>,
    @location(0) color: vec3<f32>,
}

@vertex
fn colored_vertex(@location(0) position: vec3<f32>, @location(2) color: vec3<f32>) -> Colored {
    return Colored(uniforms.clip_from_world * vec4(position, 1.0), color);
}

@fragment
fn colored_fragment(in: Colored) -> @location(0) vec4<f32> {
    return vec4(in.color, 1.0);
}

@fragment
fn translucent_fragment(in: Colored) -> @location(0) vec4<f32> {
    return vec4(in.color, 0.5);
}

struct Lit {
    @builtin(position) position: vec4<f32>,
    @location(0) world: vec3<f32>,
    @location(1) normal: vec3<f32>,
}

@vertex
fn lit_vertex(@location(0) position: vec3<f32>, @location(1) normal: vec3<f32>) -> Lit {
    return Lit(uniforms.clip_from_world * vec4(position, 1.0), position, normal);
}

@fragment
fn lit_fragment(in: Lit) -> @location(0) vec4<f32> {
    let normal = normalize(in.normal);
    let view = normalize(uniforms.eye - in.world);
    let half_way = normalize(uniforms.light + view);
    let diffuse = uniforms.ambient + max(dot(normal, uniforms.light), 0.0);
    let highlight = uniforms.specular * power_32(max(dot(normal, half_way), 0.0));
    return vec4(uniforms.albedo * diffuse + highlight, 1.0);
}

// Five squarings: cheaper on every driver than the logarithm and exponential behind `pow`.
fn power_32(x: f32) -> f32 {
    let x2 = x * x;
    let x4 = x2 * x2;
    let x8 = x4 * x4;
    let x16 = x8 * x8;
    return x16 * x16;
}
