//! The scenes: plain vertices and indices, the same for every backend and on every run.

mod city;
mod fill;
mod floor;
mod knot;
mod matrix;
mod micro;
mod slivers;
mod small_draws;
mod texture;

use clap::ValueEnum;
use matrix::Matrix;
use serde::{Deserialize, Serialize};
use std::ops::Range;
pub(crate) use texture::{SIZE as TEXTURE_SIZE, Texture};

/// A picture's width and height in pixels.
pub(crate) type Size = [u32; 2];
/// What most scenes are drawn at.
const FULL_HD: Size = [1920, 1080];
/// A thumbnail.
const SMALL: Size = [256, 256];
/// Every picture is cleared to opaque black, which is the same code in any rounding.
#[cfg(any(feature = "pineda", feature = "vulkan"))]
pub(crate) const CLEAR_COLOR: [f32; 4] = [0.0, 0.0, 0.0, 1.0];
/// The same as 8-bit codes, for backends that clear memory themselves.
pub(crate) const CLEAR_CODES: [u8; 4] = [0, 0, 0, 255];

/// Which scene to draw.
#[derive(Clone, Copy, Debug, Deserialize, Eq, Ord, PartialEq, PartialOrd, Serialize, ValueEnum)]
#[serde(rename_all = "snake_case")]
#[value(rename_all = "snake_case")]
pub(crate) enum SceneName {
    /// 16 full-screen layers, the nearest first.
    FillFrontToBack,
    /// 16 full-screen layers, the farthest first.
    FillBackToFront,
    /// A million triangles of about two pixels.
    Micro,
    /// A knot of 70,000 triangles, lit per pixel.
    Medium,
    /// The knot with four samples a pixel, averaged.
    Msaa,
    /// 16 full-screen layers, half transparent, the farthest first.
    Blend,
    /// A city of 200,000 triangles, of which the depth buffer is wanted and nothing else.
    DepthOnly,
    /// The knot's triangle numbers.
    Ids,
    /// The knot with a trilinear texture.
    Textured,
    /// A floor to the horizon, its texture filtered with 16 lookups at grazing angles.
    Floor,
    /// The knot with nine lookups of a shadow map.
    Shadowed,
    /// The knot, physically based, with five trilinear textures.
    FiveTextures,
    /// The knot at 256 x 256.
    Knot256,
    /// Triangles half a pixel wide on average and as long as the screen.
    Slivers,
    /// 2,000 draws of 96 triangles, each with another matrix and other fixed functions than the one before.
    SmallDraws,
    /// A knot of 10,000 triangles at 256 x 256, by a fresh process from its start to its end.
    ColdStart,
}

/// A vertex as the caller would keep it: 36 bytes, one record.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Vertex {
    /// In world space.
    pub(crate) position: [f32; 3],
    /// Of length one, in world space.
    pub(crate) normal: [f32; 3],
    /// Linear red, green, blue in 0..=1; where there are textures, their coordinates and 0.
    pub(crate) color: [f32; 3],
}

/// What a fragment is coloured with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Shading {
    /// The interpolated vertex colour, half transparent for draws that blend.
    Gouraud,
    /// Blinn-Phong per pixel.
    BlinnPhong(BlinnPhong),
    /// The same with the first texture as albedo.
    Textured(BlinnPhong),
    /// The first texture, as it is, anisotropic.
    Floor,
    /// Blinn-Phong; the light shines where a depth map lets it: nine comparisons, each filtered, around the place that the position has in it.
    Shadowed(BlinnPhong),
    /// Metal and dielectrics by glTF 2.0's appendix B (GGX, height-correlated Smith, Schlick) in one light and a little from all around; albedo, normal, roughness and metalness, occlusion and emission
    /// are textures.
    FiveTextures(BlinnPhong),
}

/// The uniforms of the lit scene, in world space and linear light:
/// albedo x (ambient + max(0, n . l)) + specular x max(0, n . h)^32, h halfway between the light and the eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct BlinnPhong {
    pub(crate) eye: [f32; 3],
    /// Towards the light, of length one.
    pub(crate) light: [f32; 3],
    pub(crate) albedo: [f32; 3],
    pub(crate) ambient: f32,
    pub(crate) specular: f32,
}

/// What is to be in the caller's memory when a frame is done.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Output {
    /// The picture.
    Color,
    /// The depth buffer, f32; no picture is drawn.
    Depth,
    /// The number of the triangle that each pixel shows, u32, all bits set where there is none; back faces are culled.
    Ids,
}

/// A depth as a shade of gray, for pictures to be compared.
pub(crate) fn gray(depth: f32) -> [u8; 4] {
    let code = (depth.clamp(0.0, 1.0) * 255.0).round() as u8;
    [code, code, code, 255]
}

/// What is fixed about a draw's fragments.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq)]
pub(crate) struct State {
    pub(crate) culls_back_faces: bool,
    /// Half and half with what is there; depth is tested and not written.
    pub(crate) blends: bool,
    /// Depth passes where it is equal, too.
    pub(crate) passes_equal: bool,
}

impl State {
    /// One side of opaque surfaces.
    const FRONT: Self = Self { culls_back_faces: true, blends: false, passes_equal: false };
}

/// One draw.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Draw {
    /// Which of the scene's indices.
    pub(crate) indices: Range<u32>,
    /// Rows of the matrix that takes (x, y, z, 1) to clip space: x right, y up, 0 <= z <= w.
    pub(crate) clip_from_world: Matrix,
    pub(crate) state: State,
}

/// Everything that a backend needs to draw one frame: indexed triangles, depth-tested `Less`, front faces counter-clockwise.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Scene {
    pub(crate) size: Size,
    pub(crate) vertices: Vec<Vertex>,
    pub(crate) indices: Vec<u32>,
    pub(crate) draws: Vec<Draw>,
    pub(crate) shading: Shading,
    pub(crate) output: Output,
    pub(crate) textures: Vec<Texture>,
    /// As large as a texture; empty without shadows.
    pub(crate) shadow_map: Vec<u16>,
    /// Of each pixel: 1 or 4. The picture holds their averages.
    pub(crate) samples: u32,
}

impl Scene {
    /// One draw of everything, at full size, without textures.
    fn plain(
        vertices: Vec<Vertex>,
        indices: Vec<u32>,
        clip_from_world: Matrix,
        state: State,
        shading: Shading,
    ) -> Self {
        Self {
            size: FULL_HD,
            draws: vec![Draw { indices: 0..indices.len() as u32, clip_from_world, state }],
            vertices,
            indices,
            shading,
            output: Output::Color,
            textures: Vec::new(),
            shadow_map: Vec::new(),
            samples: 1,
        }
    }

    /// [`SceneName::Micro`] with about so many triangles.
    pub(crate) fn of_triangles(triangles: u32) -> Self {
        micro::sheet(triangles)
    }

    /// [`SceneName::Medium`], square, of so many pixels each way.
    pub(crate) fn of_pixels(side: u32) -> Self {
        knot::lit_knot([side, side], knot::FINE)
    }

    /// The memory of vertices and indices.
    pub(crate) fn mib(&self) -> f64 {
        (size_of_val(&self.vertices[..]) + size_of_val(&self.indices[..])) as f64 / f64::from(1 << 20)
    }

    /// Builds the scene; always the same bits, because the only transcendental functions are `libm`'s.
    pub(crate) fn new(name: SceneName) -> Self {
        match name {
            SceneName::FillFrontToBack => fill::layers(fill::Order::FrontToBack),
            SceneName::FillBackToFront => fill::layers(fill::Order::BackToFront),
            SceneName::Micro => micro::sheet(micro::TRIANGLES),
            SceneName::Medium => knot::lit_knot(FULL_HD, knot::FINE),
            SceneName::Msaa => Self { samples: 4, ..knot::lit_knot(FULL_HD, knot::FINE) },
            SceneName::Blend => fill::translucent_layers(),
            SceneName::DepthOnly => city::occluders(),
            SceneName::Ids => Self { output: Output::Ids, ..knot::lit_knot(FULL_HD, knot::FINE) },
            SceneName::Textured => knot::textured_knot(1, Shading::Textured),
            SceneName::Floor => floor::floor(),
            SceneName::Shadowed => Self { shadow_map: texture::waves(), ..knot::textured_knot(0, Shading::Shadowed) },
            SceneName::FiveTextures => knot::textured_knot(5, Shading::FiveTextures),
            SceneName::Knot256 => knot::lit_knot(SMALL, knot::FINE),
            SceneName::Slivers => slivers::needles(),
            SceneName::SmallDraws => small_draws::balls(),
            SceneName::ColdStart => knot::lit_knot(SMALL, knot::COARSE),
        }
    }
}

impl SceneName {
    /// The name as typed on the command line.
    pub(crate) fn as_str(self) -> &'static str {
        match self {
            Self::FillFrontToBack => "fill_front_to_back",
            Self::FillBackToFront => "fill_back_to_front",
            Self::Micro => "micro",
            Self::Medium => "medium",
            Self::Msaa => "msaa",
            Self::Blend => "blend",
            Self::DepthOnly => "depth_only",
            Self::Ids => "ids",
            Self::Textured => "textured",
            Self::Floor => "floor",
            Self::Shadowed => "shadowed",
            Self::FiveTextures => "five_textures",
            Self::Knot256 => "knot256",
            Self::Slivers => "slivers",
            Self::SmallDraws => "small_draws",
            Self::ColdStart => "cold_start",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scenes_have_the_promised_number_of_triangles() {
        for (name, triangles) in [
            (SceneName::FillFrontToBack, 32),
            (SceneName::FillBackToFront, 32),
            (SceneName::Micro, 1_000_000),
            (SceneName::Medium, 70_000),
            (SceneName::Msaa, 70_000),
            (SceneName::Blend, 32),
            (SceneName::DepthOnly, 201_600),
            (SceneName::Ids, 70_000),
            (SceneName::Textured, 70_000),
            (SceneName::Floor, 2),
            (SceneName::Shadowed, 70_000),
            (SceneName::FiveTextures, 70_000),
            (SceneName::Knot256, 70_000),
            (SceneName::Slivers, 4_000),
            (SceneName::SmallDraws, 192_000),
            (SceneName::ColdStart, 10_000),
        ] {
            let scene = Scene::new(name);
            assert_eq!(scene.indices.len(), 3 * triangles, "{name:?}");
            assert!(scene.indices.iter().all(|&index| (index as usize) < scene.vertices.len()), "{name:?}");
            let drawn: u32 = scene.draws.iter().map(|draw| draw.indices.end - draw.indices.start).sum();
            assert_eq!(drawn as usize, 3 * triangles, "{name:?}");
        }
    }

    #[test]
    fn scenes_are_the_same_on_every_run() {
        for name in SceneName::value_variants() {
            assert_eq!(Scene::new(*name), Scene::new(*name));
        }
    }
}
