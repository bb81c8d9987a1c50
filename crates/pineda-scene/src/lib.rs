//! Models in, no pixels: OBJ, STL, PLY, 3MF and glTF 2.0 become one [`Scene`] that a renderer draws as it is, together with
//! the camera that shows all of it.
//!
//! ```
//! use pineda_scene::{Bounds, Format, Framing, Limits, NoFiles, Normals, View, load_bytes, smooth_normals};
//!
//! let obj = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
//! let mut loaded = load_bytes(obj, Format::Obj, &NoFiles, &Limits::default())?;
//! for object in &mut loaded.scene.objects {
//!     if object.normals == Normals::Absent {
//!         smooth_normals(object, 40.0);
//!     }
//! }
//! let square = &loaded.scene.objects[0];
//! assert_eq!(square.triangles, [[0, 1, 2], [0, 2, 3]]);
//! assert_eq!(square.vertices[0].normal, [0.0, 0.0, 1.0]);
//! assert!(loaded.notes.is_empty());
//!
//! let bounds = Bounds::of(&loaded.scene).expect("a loaded scene is not empty");
//! let camera = Framing::new(&bounds, &View::default())?;
//! assert_eq!(camera.target, [0.5, 0.5, 0.0]);
//! # Ok::<(), pineda_scene::Error>(())
//! ```
//!
//! - [`load`] reads a file, [`load_with`] with limits of your own, [`load_bytes`] reads bytes: no file system needed.
//!   What a reader leaves out (a missing image or material library, an extension that it does not know) is a line each in
//!   [`Loaded::notes`].
//! - A [`Model`] is read once and shown in any [`Pose`]: another scene of the file, an animation at a time, a material
//!   variant. [`Model::contents`] says what there is. Images are decoded when a pose first shows them, and shared.
//! - A [`Scene`] is a list of [`Object`]s (vertices in world space, triangles, lines and points, one material each), of
//!   [`Material`]s in glTF's terms, of the [`Texture`]s and [`Image`]s that they look up, and of the file's own
//!   [`Camera`]s and [`Light`]s. World space is right-handed with y up, as in glTF; 3MF, whose z is up, is turned, and the
//!   other formats, which do not say which way is up, are taken as they are.
//! - Colours are linear light. Vertex colours of OBJ, STL and PLY files and colours of MTL and 3MF files are taken for sRGB and
//!   decoded; glTF's are linear already. Images stay as they are stored: each use in [`Material`] says what they mean.
//! - [`flat_normals`] and [`smooth_normals`] make normals where a file has none.
//! - [`Bounds`], [`View`] and [`Framing`] put the whole of a scene into the picture.
//! - [`demo`] is a scene built in code.
//!
//! | format | what is read |
//! | --- | --- |
//! | glTF 2.0, .gltf and .glb | the core whole: accessors of every kind, all primitive modes, node hierarchies, scenes, cameras, skins of 4 and 8 influences, morph targets, animations, samplers, PNG, JPEG and WebP images. KHR_draco_mesh_compression, KHR_lights_punctual, KHR_materials_anisotropy, clearcoat, emissive_strength, ior, iridescence, pbrSpecularGlossiness, sheen, specular, transmission, unlit, variants and volume, KHR_mesh_quantization, KHR_meshopt_compression and its older EXT_ form, KHR_texture_transform, EXT_mesh_gpu_instancing, EXT_texture_webp. Others: an error if the file requires them, a line if it uses them |
//! | OBJ | polygons of any size, groups, texture coordinates, normals, vertex colours, lines, points; MTL with its images |
//! | PLY | ASCII and binary of both byte orders, polygons, strips, clouds of points, normals, colours, texture coordinates of vertices and of faces' corners |
//! | 3MF | meshes, components, items, base materials and groups of colours, parts of the production extension; z of the file is y of the scene. Units are not converted. Others: an error if the file requires an extension, a line if it has one |
//! | STL | ASCII and binary, several solids, colours of VisCAM and Magics |
//!
//! KHR_texture_basisu is not read: there is no decoder yet that is Rust alone and kept well.
//!
//! Files are not trusted. A damaged or hostile one gives an [`Error`] that says what is wrong, where, and what to do;
//! never a panic. Memory and time are bounded by [`Limits`], and every count in a file is checked against the bytes
//! that are there before anything is allocated.
//!
//! The same file gives the same bits on every platform: nothing but IEEE `+ - * / sqrt`, correctly rounded decimal
//! conversion and the [`libm`] crate touches a number.

mod bounds;
mod camera;
mod color;
mod demo;
mod error;
mod finish;
mod format;
mod framing;
mod gltf;
mod image;
mod limits;
mod load;
mod material;
mod model;
mod normals;
mod note;
mod obj;
mod ply;
mod polygon;
mod pose;
mod resolver;
mod scene;
mod stl;
mod text;
mod texture;
mod threemf;
mod tight;
mod vector;

pub use bounds::Bounds;
pub use camera::{Camera, Light, LightKind, Projection};
pub use demo::demo;
pub use error::Error;
pub use format::Format;
pub use framing::{Framing, Lens, View};
pub use limits::Limits;
pub use load::{Loaded, load, load_bytes, load_with};
pub use material::{
    AlphaMode, Anisotropy, Clearcoat, Iridescence, Material, Sheen, Specular, SpecularGlossiness, Transmission, Volume,
};
pub use model::{Animation, Contents, Model};
pub use normals::{flat_normals, smooth_normals};
pub use pose::{Pose, Select};
pub use resolver::{Folder, NoFiles, Resolver, read_file};
pub use scene::{Normals, Object, Scene, Vertex};
pub use texture::{Filter, Image, Sampler, Texels, Texture, TextureRef, Wrap};
