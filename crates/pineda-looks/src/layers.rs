//! In which order a stage is drawn, and how each draw meets what is there.
//!
//! 1. What is opaque, in the scene's order.
//! 2. What is cut out (`MASK`): its depth alone, by [`CutOut`](crate::CutOut).
//! 3. The same again, for what it looks like, where its depth is the one that is there.
//! 4. What is blended (`BLEND`), from back to front by the middles of the objects' boxes; of one that is double sided, the back faces before the front faces.

use crate::stage::{Prop, Stage};
use crate::surface::Vertex;
use pineda::{Blend, ColorMask, Compare, Cull, DepthState, DrawState, Mesh, PrimitiveTopology};
use pineda_scene::AlphaMode;

/// One draw.
#[derive(Clone, Copy, Debug)]
pub struct Layer<'a> {
    /// The object's number on the stage and in the scene.
    pub number: usize,
    /// The object.
    pub prop: &'a Prop,
    /// Its triangles, its lines or its points.
    pub mesh: Mesh<'a, Vertex>,
    /// Everything but how multisampled pixels are shaded.
    pub state: DrawState,
    /// Whether this draw is [`CutOut`](crate::CutOut)'s and writes depth only.
    pub is_cut: bool,
}

/// What alpha is taken for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Alpha {
    /// Nothing: all is opaque.
    Ignored,
    /// `MASK` cuts out; what would be blended is opaque.
    Cuts,
    /// `MASK` cuts out, `BLEND` blends.
    Blends,
}

impl Stage {
    /// The draws that show the stage.
    #[must_use]
    pub fn layers(&self, alpha: Alpha) -> Vec<Layer<'_>> {
        let numbered = || self.props.iter().enumerate();
        let is_cut = |prop: &Prop| alpha >= Alpha::Cuts && matches!(prop.alpha_mode(), AlphaMode::Mask { .. });
        let is_blended = |prop: &Prop| alpha >= Alpha::Blends && prop.alpha_mode() == AlphaMode::Blend;
        let mut layers = Vec::with_capacity(self.props.len());
        for (number, prop) in numbered().filter(|(_, prop)| !is_cut(prop) && !is_blended(prop)) {
            add(&mut layers, number, prop, prop.state(), false);
        }
        for (number, prop) in numbered().filter(|(_, prop)| is_cut(prop)) {
            add(&mut layers, number, prop, DrawState { color_mask: ColorMask::NONE, ..prop.state() }, true);
        }
        for (number, prop) in numbered().filter(|(_, prop)| is_cut(prop)) {
            let depth = DepthState { compare: Compare::Equal, write: false };
            add(&mut layers, number, prop, DrawState { depth, ..prop.state() }, false);
        }
        let mut blended: Vec<_> = numbered().filter(|(_, prop)| is_blended(prop)).collect();
        // Stable: what is equally far away keeps its order.
        blended.sort_by(|(_, a), (_, b)| b.distance_squared.total_cmp(&a.distance_squared));
        for (number, prop) in blended {
            let depth = DepthState { write: false, ..DepthState::default() };
            let state = DrawState { depth, blend: Blend::ALPHA, ..prop.state() };
            for (mesh, topology) in prop.meshes() {
                for state in sides(DrawState { topology, ..state }) {
                    layers.push(Layer { number, prop, mesh, state, is_cut: false });
                }
            }
        }
        layers
    }
}

fn add<'a>(layers: &mut Vec<Layer<'a>>, number: usize, prop: &'a Prop, state: DrawState, is_cut: bool) {
    for (mesh, topology) in prop.meshes() {
        layers.push(Layer { number, prop, mesh, state: DrawState { topology, ..state }, is_cut });
    }
}

/// The draws that blend a mesh: of what has two sides, the back faces before the front faces.
pub(crate) fn sides(state: DrawState) -> impl Iterator<Item = DrawState> {
    let has_two_sides = state.topology == PrimitiveTopology::TriangleList && state.cull == Cull::None;
    let culls = if has_two_sides { [Some(Cull::Front), Some(Cull::Back)] } else { [Some(state.cull), None] };
    culls.into_iter().flatten().map(move |cull| DrawState { cull, ..state })
}
