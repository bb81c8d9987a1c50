//! The shader that the oracle can look through: its colour is its varyings.

use pineda::{Fragment, Lanes, Rgba, Shader, Vec2, Vec4, shader, varyings};

/// A position in the draw's space, and four attributes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ProbeVertex {
    /// What the vertex stage returns.
    pub position: [f32; 4],
    /// Interpolated with perspective.
    pub smooth: [f32; 2],
    /// Interpolated on the screen.
    pub linear: [f32; 2],
}

varyings! {
    /// What [`Probe`] interpolates.
    pub struct Probed {
        /// With perspective.
        pub smooth: Vec2,
        /// On the screen.
        #[noperspective]
        pub linear: Vec2,
    }
}

/// Shows the interpolated `smooth` in red and green, `linear` in blue and alpha.
#[derive(Clone, Copy, Debug)]
pub struct Probe;

#[shader]
impl Shader for Probe {
    type Vertex = ProbeVertex;
    type Varyings<L: Lanes> = Probed<L>;
    fn vertex(&self, v: &ProbeVertex) -> (Vec4, Probed) {
        (v.position.into(), Probed { smooth: v.smooth.into(), linear: v.linear.into() })
    }
    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let (Vec2 { x: r, y: g }, Vec2 { x: b, y: a }) = (f.smooth, f.linear);
        Rgba { r, g, b, a }
    }
}
