//! The shaders of the golden scenes.

use pineda::*;

/// What all scenes are made of. Positions that need no camera are in the draw's space already.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Vertex {
    pub(crate) position: [f32; 4],
    pub(crate) normal: [f32; 3],
    pub(crate) color: [f32; 4],
}

/// Colours from corner to corner.
pub(crate) struct Gouraud {
    pub(crate) camera: Mat4,
}

#[shader]
impl Shader for Gouraud {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Rgba<L>;
    fn vertex(&self, v: &Vertex) -> (Vec4, Rgba) {
        (self.camera * Vec4::from(v.position), v.color.into())
    }
    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        f.varyings()
    }
}

varyings! {
    pub(crate) struct Lit {
        world: Vec3,
        normal: Vec3,
        color: Vec3,
    }
}

/// Blinn and Phong's highlights, per pixel.
pub(crate) struct BlinnPhong {
    pub(crate) camera: Mat4,
    pub(crate) eye: [f32; 3],
    pub(crate) light: [f32; 3],
}

#[shader]
impl Shader for BlinnPhong {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Lit<L>;
    fn vertex(&self, v: &Vertex) -> (Vec4, Lit) {
        let [x, y, z, w] = v.position;
        let [r, g, b, _] = v.color;
        let lit = Lit { world: [x, y, z].into(), normal: v.normal.into(), color: [r, g, b].into() };
        (self.camera * Vec4::from([x, y, z, w]), lit)
    }
    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let normal = f.normal.normalize();
        let half = ((self.eye - f.world).normalize() + self.light).normalize();
        let diffuse = normal.dot(self.light).max(0.0);
        let specular = normal.dot(half).max(0.0).powf(40.0);
        Rgba::opaque(f.color * (0.1 + 0.8 * diffuse) + 0.5 * specular)
    }
}

varyings! {
    pub(crate) struct Modes {
        smooth: Real,
        #[noperspective]
        linear: Real,
        #[flat]
        flat: Real,
    }
}

/// Stripes of the three ways to interpolate, sharpened by the derivatives: red with perspective, green without, blue flat.
pub(crate) struct Stripes {
    pub(crate) camera: Mat4,
}

#[shader]
impl Shader for Stripes {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Modes<L>;
    const DERIVATIVES: bool = true;
    fn vertex(&self, v: &Vertex) -> (Vec4, Modes) {
        let [r, g, b] = [v.color[0], v.color[1], v.color[2]].map(|x| Real::new(Scalar, x));
        (self.camera * Vec4::from(v.position), Modes { smooth: r, linear: g, flat: b })
    }
    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let (smooth, linear) = ((f.smooth * 8.0).fract(), (f.linear * 8.0).fract());
        let thickness = (f.dx().smooth.abs() + f.dy().smooth.abs()) * 8.0;
        let red = smooth.smoothstep(0.5 - thickness, 0.5 + thickness);
        Rgba { r: red, g: linear.step(0.5), b: f.flat, a: f.splat(1.0) }
    }
}

/// Colours with holes: what is dark is not there.
pub(crate) struct Holes {
    pub(crate) camera: Mat4,
}

#[shader]
impl Shader for Holes {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Rgba<L>;
    const DISCARDS: bool = true;
    fn vertex(&self, v: &Vertex) -> (Vec4, Rgba) {
        (self.camera * Vec4::from(v.position), v.color.into())
    }
    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let (u, v) = ((f.r * 6.0).fract() - 0.5, (f.g * 6.0).fract() - 0.5);
        f.discard((u * u + v * v).lt(0.1));
        f.varyings()
    }
}

/// What lies in a prism, whose sides are eight clip distances; the inside of what is cut open is dull.
pub(crate) struct CutOpen {
    pub(crate) camera: Mat4,
    pub(crate) radius: f32,
}

#[shader]
impl Shader for CutOpen {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Lit<L>;
    const CLIP_DISTANCES: usize = 8;

    fn vertex(&self, v: &Vertex) -> (Vec4, Lit) {
        let [x, y, z, w] = v.position;
        let [r, g, b, _] = v.color;
        let lit = Lit { world: [x, y, z].into(), normal: v.normal.into(), color: [r, g, b].into() };
        (self.camera * Vec4::from([x, y, z, w]), lit)
    }

    fn clip_distances(&self, v: &Vertex) -> [f32; MAX_CLIP_DISTANCES] {
        let [x, y, z, _] = v.position;
        let (d, s) = (self.radius, 0.707);
        [d - x, d + x, d - y, d + y, d - s * (x + y), d - s * (x - y), 1.1 * d + s * (x - y), 0.4 + s * (z + y)]
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let diffuse = f.normal.normalize().dot([0.36, 0.48, 0.8]).max(0.0);
        let outside = f.color * (0.15 + 0.85 * diffuse);
        Rgba::opaque(f.front_facing().select(outside, f.splat([0.10, 0.11, 0.13])))
    }
}
