//! Ready shaders for [`pineda`]: how a surface looks, given a camera and a base colour.
//!
//! | shader | what it shows | target |
//! | --- | --- | --- |
//! | [`Studio`] | a photographer's soft light: key, fill, rim and a bright sky | `Rgba8Srgb`, `Rgba32F` |
//! | [`Lambert`] | one distant light and a quarter of ambient light | `Rgba8Srgb`, `Rgba32F` |
//! | [`Normals`] | the normal, `n * 0.5 + 0.5` | `Rgba8`, `Rgba32F` |
//! | [`Depth`] | the distance along the view axis, 0 at the near and 1 at the far plane | `Rgba32F` |
//!
//! All of them draw a [`Vertex`] buffer in world space. Back faces turn their normals around, so both sides of a surface
//! are lit; alpha is always 1. Which object and triangle a pixel shows needs no shader:
//! [`Target::draw_ids`](pineda::Target) and [`Target::triangle_ids`](pineda::Target) say it.
//!
//! ```
//! use pineda::{ColorBuffer, DrawState, Indices, Mat4, Mesh, Pass, Renderer, Settings, Target};
//! use pineda_looks::{Lambert, Vertex};
//!
//! let corner = |x, y| Vertex { position: [x, y, 0.0], normal: [0.0, 0.0, 1.0], ..Vertex::default() };
//! let triangle = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(0.0, 1.0)];
//! let view = Mat4::look_at([0.0, 0.0, 3.0], [0.0; 3], [0.0, 1.0, 0.0]);
//! let shader = Lambert {
//!     clip_from_world: Mat4::perspective(0.8, 1.0, 1.0, 5.0) * view,
//!     base_color: [1.0, 0.5, 0.2],
//!     ..Lambert::default()
//! };
//! let mut pass = Pass::new();
//! pass.draw(&shader, Mesh { vertices: &triangle, indices: Indices::Sequential }, DrawState::default());
//! let mut pixels = vec![[0; 4]; 64 * 64];
//! let mut target = Target { color: ColorBuffer::Rgba8Srgb(&mut pixels), ..Target::new(64, 64) };
//! Renderer::new(Settings::default())?.render(&pass, &mut target)?;
//! assert_eq!(pixels[32 * 64 + 32][3], 255);
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
mod studio;
mod surface;
mod tangent_frame;
mod tone;
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
pub use studio::{Lamp, Studio};
pub use surface::{Surface, Vertex};
pub use unlit::Unlit;
pub use uv::Uv;
pub use wireframe::Wireframe;
