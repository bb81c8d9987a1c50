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

@group(0) @binding(1) var trilinear: sampler;
@group(0) @binding(2) var texture_0: texture_2d<f32>;
@group(0) @binding(3) var texture_1: texture_2d<f32>;
@group(0) @binding(4) var texture_2: texture_2d<f32>;
@group(0) @binding(5) var texture_3: texture_2d<f32>;
@group(0) @binding(6) var texture_4: texture_2d<f32>;
@group(0) @binding(7) var shadow_map: texture_depth_2d;
@group(0) @binding(8) var comparison: sampler_comparison;

struct Mapped {
    @builtin(position) position: vec4<f32>,
    @location(0) world: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) uv: vec2<f32>,
}

@vertex
fn mapped_vertex(
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) color: vec3<f32>,
) -> Mapped {
    return Mapped(uniforms.clip_from_world * vec4(position, 1.0), position, normal, color.xy);
}

// How much of the light the surface scatters, and how much it mirrors.
fn light(position: vec3<f32>, wanted: vec3<f32>) -> vec2<f32> {
    let normal = normalize(wanted);
    let view = normalize(uniforms.eye - position);
    let half_way = normalize(uniforms.light + view);
    return vec2(max(dot(normal, uniforms.light), 0.0), uniforms.specular * power_32(max(dot(normal, half_way), 0.0)));
}

@fragment
fn textured_fragment(in: Mapped) -> @location(0) vec4<f32> {
    let lit = light(in.world, in.normal);
    let albedo = textureSample(texture_0, trilinear, in.uv).rgb;
    return vec4(albedo * (uniforms.ambient + lit.x) + lit.y, 1.0);
}

@fragment
fn floor_fragment(in: Mapped) -> @location(0) vec4<f32> {
    return textureSample(texture_0, trilinear, in.uv);
}

@fragment
fn shadowed_fragment(in: Mapped) -> @location(0) vec4<f32> {
    let surface = light(in.world, in.normal);
    let place = in.world.xy * 0.1 + 0.5;
    let depth = 0.5 - 0.1 * in.world.z;
    var sum = 0.0;
    for (var y = -1; y <= 1; y++) {
        for (var x = -1; x <= 1; x++) {
            sum += textureSampleCompareLevel(shadow_map, comparison, place + vec2(f32(x), f32(y)) / 1024.0, depth);
        }
    }
    let lit = sum / 9.0;
    return vec4(uniforms.albedo * (uniforms.ambient + surface.x * lit) + surface.y * lit, 1.0);
}

@fragment
fn five_textures_fragment(in: Mapped) -> @location(0) vec4<f32> {
    let albedo = textureSample(texture_0, trilinear, in.uv).rgb;
    let bump = textureSample(texture_1, trilinear, in.uv).rgb - 0.5;
    let metal = textureSample(texture_2, trilinear, in.uv);
    let roughness = metal.g * 0.7 + 0.2;
    let metalness = metal.b;
    let occlusion = textureSample(texture_3, trilinear, in.uv).r;
    let emission = textureSample(texture_4, trilinear, in.uv).rgb * 0.05;

    let normal = normalize(in.normal + bump);
    let view = normalize(uniforms.eye - in.world);
    let half_way = normalize(uniforms.light + view);
    let n_l = max(dot(normal, uniforms.light), 0.0);
    let n_v = max(dot(normal, view), 1e-3);
    let n_h = max(dot(normal, half_way), 0.0);
    let v_h = max(dot(view, half_way), 0.0);

    // GGX with height-correlated Smith, each without the factors that cancel.
    let alpha = roughness * roughness;
    let alpha2 = alpha * alpha;
    let spread = n_h * n_h * (alpha2 - 1.0) + 1.0;
    let smith = n_l * sqrt(n_v * n_v * (1.0 - alpha2) + alpha2) + n_v * sqrt(n_l * n_l * (1.0 - alpha2) + alpha2);
    let mirrored = alpha2 / (spread * spread * max(smith, 1e-4) * 6.2831853);
    let f0 = albedo * metalness + (1.0 - metalness) * 0.04;
    let away = 1.0 - v_h;
    let fresnel = f0 + (1.0 - f0) * (away * away * away * away * away);
    let scattered = albedo * (1.0 - metalness) * (1.0 - fresnel) * 0.31830987;
    let lit = (scattered + fresnel * mirrored) * (n_l * 3.1415927);
    return vec4(lit + albedo * (occlusion * uniforms.ambient) + emission, 1.0);
}
