//! How models look: physically based ([`pbr`]), and modes for tools and tests, drawn by [`pineda`].
//!
//! A [`Stage`] is a scene and a camera, made ready to draw; [`Show`] has the shaders that show it in a [`Mode`]:
//!
//! | mode | shader | what it shows | target |
//! | --- | --- | --- | --- |
//! | [`Unlit`](Mode::Unlit) | [`Unlit`] | base colour, texture and vertex colour, no light | `Rgba8Srgb`, `Rgba32F` |
//! | [`Lambert`](Mode::Lambert) | [`Lambert`], [`MappedLambert`] | one distant light and a quarter of ambient light | `Rgba8Srgb`, `Rgba32F` |
//! | [`Normals`](Mode::Normals) | [`Normals`], [`MappedNormals`] | the normal, `n * 0.5 + 0.5` | `Rgba8`, `Rgba32F` |
//! | [`Depth`](Mode::Depth) | [`Depth`] | the distance along the view axis, 0 at the near and 1 at the far plane | `Rgba32F` |
//! | [`Uv`](Mode::Uv) | [`Uv`] | texture coordinates in red and green | `Rgba8`, `Rgba32F` |
//! | [`Wireframe`](Mode::Wireframe) | [`Wireframe`] | edges on a pale surface | `Rgba8Srgb`, `Rgba32F` |
//! | [`Matcap`](Mode::Matcap) | [`Matcap`] | clay that was lit once and for all: shapes without materials | `Rgba8Srgb`, `Rgba32F` |
//! | [`Overdraw`](Mode::Overdraw) | [`CutOut`] | how many fragments a pixel gets | `R32F`, `Rgba32F` |
//!
//! Which object and triangle a pixel shows needs no shader: [`Target::draw_ids`](pineda::Target) and [`Target::triangle_ids`](pineda::Target) say it, and
//! [`Target::hits`](pineda::Target) how many triangles cover it.
//!
//! Back faces turn their normals around, so both sides of a surface are lit. What is cut out (`MASK`) is not there, in all modes but wireframes; what is blended (`BLEND`) is so in the first two modes, and opaque in the others.
//! A picture whose background is transparent black has its colours multiplied by alpha then: it wants a target of floats, and to be divided by alpha at last.
//!
//! ```
//! use pineda::{ColorBuffer, Pass, Renderer, Settings, Target};
//! use pineda_looks::{Mode, Show, Stage, Textures};
//! use pineda_scene::{Bounds, Framing, View};
//!
//! let mut scene = pineda_scene::demo();
//! let framing = Framing::new(&Bounds::of(&scene).expect("not empty"), &View::default()).expect("a view");
//! let stage = Stage::new(&mut scene, &framing, 1.0, 40.0).expect("not empty");
//! let show = Show::new(&stage, &scene, Mode::Lambert, Textures::default())?;
//! let mut pass = Pass::new();
//! show.record(&stage, &mut pass);
//! let mut pixels = vec![[0; 4]; 64 * 64];
//! let mut target = Target { color: ColorBuffer::Rgba8Srgb(&mut pixels), ..Target::new(64, 64) };
//! Renderer::new(Settings::default())?.render(&pass, &mut target)?;
//! assert!(pixels.iter().any(|pixel| pixel[3] == 255));
//! # Ok::<(), pineda::Error>(())
//! ```

mod base_color;
mod cut_out;
mod depth;
mod gallery;
mod lambert;
mod layers;
mod matcap;
mod mode;
mod normal_map;
mod normals;
pub mod pbr;
mod stage;
mod surface;
mod tangent_frame;
mod unlit;
mod uv;
mod wireframe;

pub use base_color::BaseColor;
pub use cut_out::{CutOut, Opacity};
pub use depth::Depth;
pub use gallery::{Gallery, Map};
pub use lambert::Lambert;
pub use layers::{Alpha, Layer};
pub use matcap::{Matcap, Shape};
pub use mode::{Mode, Show, Textures};
pub use normal_map::{Bumpy, MappedLambert, MappedNormals, NormalMap};
pub use normals::Normals;
pub use stage::{Camera, Prop, Stage};
pub use surface::{Surface, Vertex};
pub use unlit::Unlit;
pub use uv::Uv;
pub use wireframe::Wireframe;
