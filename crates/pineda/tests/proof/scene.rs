//! What several tests draw with: soups of triangles over each other, and the two shaders to draw them with.

use pineda::*;
use pineda_oracle::cases::Random;
use pineda_proof::{Probe, ProbeVertex, Probed};

/// The same as [`Probe`], but fragments whose first varying is below zero are discarded.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CutOut;

#[shader]
impl Shader for CutOut {
    type Vertex = ProbeVertex;
    type Varyings<L: Lanes> = Probed<L>;
    const DISCARDS: bool = true;
    fn vertex(&self, v: &ProbeVertex) -> (Vec4, Probed) {
        (v.position.into(), Probed { smooth: v.smooth.into(), linear: v.linear.into() })
    }
    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let (Vec2 { x: r, y: g }, Vec2 { x: b, y: a }) = (f.smooth, f.linear);
        f.discard(r.lt(0.0));
        Rgba { r, g, b, a }
    }
}

/// One draw: triangles in raster space, three vertices each.
#[derive(Clone, Debug)]
pub(crate) struct Layer {
    pub(crate) vertices: Vec<ProbeVertex>,
    pub(crate) state: DrawState,
    pub(crate) discards: bool,
}

impl Layer {
    /// A random soup with every depth one of a few, so that equal depths are common; a third of the triangles is flat in depth.
    pub(crate) fn random(random: &mut Random, width: u32, height: u32, triangles: usize) -> Self {
        let mut vertices = Vec::new();
        for _ in 0..triangles {
            let size = random.pick(&[2.0, 8.0, 40.0, 300.0]);
            let middle = [random.real(0.0, width as f32), random.real(0.0, height as f32)];
            let depth = random.pick(&[0.0, 0.25, 0.5, 0.75, 1.0]);
            let flat = random.one_in(3);
            for _ in 0..3 {
                let z = if flat { depth } else { random.between(0, 8) as f32 / 8.0 };
                let [x, y] = middle.map(|x| x + random.real(-size, size));
                let mut attribute = || random.real(-1.0, 1.0);
                let (smooth, linear) = ([attribute(), attribute()], [attribute(), attribute()]);
                let w = if random.one_in(2) { 1.0 } else { random.magnitude(-3, 3) };
                vertices.push(ProbeVertex { position: [x, y, z, w], smooth, linear });
            }
        }
        Self { vertices, state: DrawState { space: Space::Raster, ..DrawState::default() }, discards: false }
    }

    /// Adds it to a pass.
    pub(crate) fn draw<'a>(&'a self, pass: &mut Pass<'a>) {
        let mesh = Mesh { vertices: &self.vertices, indices: Indices::Sequential };
        if self.discards {
            pass.draw(&CutOut, mesh, self.state);
        } else {
            pass.draw(&Probe, mesh, self.state);
        }
    }
}

/// A random state: any comparison, depth written or not, any blending.
pub(crate) fn random_state(random: &mut Random) -> DrawState {
    let depth = DepthState { compare: random.pick(&Compare::ALL), write: random.one_in(2) };
    let blend = random.pick(&[Blend::OPAQUE, Blend::ALPHA, Blend::PREMULTIPLIED]);
    DrawState { space: Space::Raster, depth, blend, ..DrawState::default() }
}
