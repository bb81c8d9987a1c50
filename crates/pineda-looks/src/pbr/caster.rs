//! What hides light: a prop, less what its material cuts out of it.

use crate::cut_out::CutOut;
use crate::gallery::Gallery;
use crate::stage::Prop;
use pineda::{Error, Mat4};
use pineda_scene::{AlphaMode, Scene};

/// A prop, as something in the way of light.
#[derive(Debug)]
pub(super) struct Caster<'a, 's> {
    pub(super) prop: &'a Prop,
    cut: Option<CutOut<'s>>,
}

impl<'a, 's> Caster<'a, 's> {
    /// Errors: no memory for the textures' smaller levels.
    pub(super) fn new(prop: &'a Prop, scene: &Scene, gallery: &mut Gallery<'s>, mipmaps: bool) -> Result<Self, Error> {
        let cut = match prop.alpha_mode() {
            // Whoever looks brings his own matrix.
            AlphaMode::Mask { .. } => Some(CutOut::of(prop.material(scene), Mat4::IDENTITY, gallery, mipmaps)?),
            AlphaMode::Opaque | AlphaMode::Blend => None,
        };
        Ok(Self { prop, cut })
    }

    /// The shader that leaves out what is cut out; `None` where there is all of the prop.
    pub(super) fn cut(&self, clip_from_world: Mat4) -> Option<CutOut<'s>> {
        self.cut.as_ref().map(|cut| CutOut { clip_from_world, ..cut.clone() })
    }
}
