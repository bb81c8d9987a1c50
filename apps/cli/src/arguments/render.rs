//! `pineda render`'s options.

use crate::picture::PictureFormat;
use crate::values::{
    Background, ModelFormat, SampleCount, Size, Up, Vector, crease_angle, exposure, field_of_view, finite, positive,
};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// Draws models, or without one a demo scene, in a three-quarter view
///
/// Reads OBJ, STL (ASCII, binary), PLY (ASCII, binary), 3MF, glTF and GLB. The whole model is in the picture unless a camera says otherwise.
///
/// Several models are drawn in parallel into a folder. What fails does not stop the others: it is listed at the end, and the exit code is 1.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES, args_override_self = true)]
pub(crate) struct RenderArguments {
    /// The models: .obj, .stl, .ply, .3mf, .gltf or .glb; - reads one from standard input (without the files that it may name)
    #[arg(value_name = "MODEL")]
    pub(crate) models: Vec<PathBuf>,
    #[command(flatten, next_help_heading = "Files")]
    pub(crate) files: FileArguments,
    #[command(flatten, next_help_heading = "Camera")]
    pub(crate) camera: CameraArguments,
    #[command(flatten, next_help_heading = "What of the model")]
    pub(crate) pose: PoseArguments,
    #[command(flatten, next_help_heading = "Looks")]
    pub(crate) look: LookArguments,
}

/// From where to where.
#[derive(Args, Debug)]
pub(crate) struct FileArguments {
    /// The picture: .png, .jpg, .webp (lossless), .exr (linear light, 32-bit floats) or .ppm; - writes to standard output
    #[arg(short, long, value_name = "OUT", required_unless_present = "out_dir")]
    pub(crate) output: Option<PathBuf>,
    /// The folder for pictures that are named as their models are: chair.glb becomes chair.png
    #[arg(long, value_name = "DIR", conflicts_with = "output")]
    pub(crate) out_dir: Option<PathBuf>,
    /// Makes the models' folders in --out-dir, too: chairs/a.glb becomes DIR/chairs/a.png
    #[arg(long, conflicts_with = "output")]
    pub(crate) keep_folders: bool,
    /// What pictures are, whatever their names say; needed for -o -
    #[arg(long, value_enum, value_name = "FORMAT")]
    pub(crate) picture_format: Option<PictureFormat>,
    /// What models are, whatever their names say
    #[arg(long, value_enum, value_name = "FORMAT")]
    pub(crate) model_format: Option<ModelFormat>,
    /// Of JPEGs, 1 to 100
    #[arg(long, value_name = "N", default_value_t = 92, value_parser = clap::value_parser!(u8).range(1..=100))]
    pub(crate) quality: u8,
    /// Leaves out models whose picture is there and no older than the model's own file; other files and options are not looked at
    #[arg(long, conflicts_with = "output")]
    pub(crate) resume: bool,
    /// Models that are drawn at the same time, and so in memory [default: one per thread]
    #[arg(long, value_name = "N", conflicts_with = "output", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub(crate) jobs: Option<u16>,
    /// Prints a report for programs to standard output
    #[arg(long)]
    pub(crate) json: bool,
}

/// From where to look.
#[derive(Args, Debug)]
pub(crate) struct CameraArguments {
    /// Degrees around the model, from its front (+z) towards its left (+x)
    #[arg(long, value_name = "DEG", default_value = "30", value_parser = finite, allow_negative_numbers = true)]
    pub(crate) azimuth: f64,
    /// Degrees above the horizon
    #[arg(long, value_name = "DEG", default_value = "20", value_parser = finite, allow_negative_numbers = true)]
    pub(crate) elevation: f64,
    /// Vertical field of view in degrees, 0.1 to 179
    #[arg(long, value_name = "DEG", default_value = "40", value_parser = field_of_view, allow_negative_numbers = true)]
    pub(crate) fov: f64,
    /// What is upwards in the model: x, y, z, -x, -y, -z or X,Y,Z. CAD models and scans often want z
    #[arg(long, value_name = "AXIS", default_value = "y", allow_hyphen_values = true)]
    pub(crate) up: Up,
    /// Draws without perspective: what is far away is not smaller
    #[arg(long)]
    pub(crate) orthographic: bool,
    /// What fits into the picture
    #[arg(long, value_enum, default_value = "sphere", conflicts_with_all = ["eye", "camera"])]
    pub(crate) frame: Frame,
    /// Where the camera stands, in the model's units
    #[arg(
        long, value_name = "X,Y,Z", allow_hyphen_values = true, requires = "look_at",
        conflicts_with_all = ["azimuth", "elevation", "camera"]
    )]
    pub(crate) eye: Option<Vector>,
    /// What it looks at
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, requires = "eye")]
    pub(crate) look_at: Option<Vector>,
    /// Where the near plane is, in the model's units [default: before the model]
    #[arg(long, value_name = "DIST", value_parser = positive, requires = "eye", allow_negative_numbers = true)]
    pub(crate) near: Option<f64>,
    /// Where the far plane is [default: behind the model]
    #[arg(long, value_name = "DIST", value_parser = positive, requires = "eye", allow_negative_numbers = true)]
    pub(crate) far: Option<f64>,
    /// One of the model's own cameras, by name or number, from 0
    #[arg(
        long, value_name = "NAME|INDEX",
        conflicts_with_all = ["azimuth", "elevation", "fov", "up", "orthographic"]
    )]
    pub(crate) camera: Option<String>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Frame {
    /// The sphere around the model's box: the model stays in the picture as it turns
    Sphere,
    /// The model as it is seen: it fills the picture but for 2 % on each side
    Tight,
}

/// Which of the pictures that a model holds.
#[derive(Args, Debug)]
pub(crate) struct PoseArguments {
    /// One of the model's scenes [default: the one that it says]
    #[arg(long, value_name = "NAME|INDEX")]
    pub(crate) scene: Option<String>,
    /// One of its animations [default: none; with --time, the first]
    #[arg(long, value_name = "NAME|INDEX")]
    pub(crate) animation: Option<String>,
    /// The time in the animation
    #[arg(long, value_name = "SECONDS", value_parser = finite, allow_negative_numbers = true)]
    pub(crate) time: Option<f64>,
    /// One of its material variants
    #[arg(long, value_name = "NAME|INDEX")]
    pub(crate) variant: Option<String>,
}

/// What to show, and how.
#[derive(Args, Debug)]
pub(crate) struct LookArguments {
    /// Pixels across and down
    #[arg(long, value_name = "WxH", default_value = "1024x1024")]
    pub(crate) size: Size,
    /// What to show of the surface
    #[arg(long, value_enum, default_value = "pbr")]
    pub(crate) shading: Shading,
    /// Samples a pixel: 1 (no anti-aliasing), 2, 4, 8 or 16 [default: 4 for pbr, matcap and wireframe, else 1]
    #[arg(long, value_name = "N")]
    pub(crate) samples: Option<SampleCount>,
    /// transparent, studio, black, white, gray, #rgb or #rrggbb [default: studio with pbr shading, else transparent; white in JPEGs]
    #[arg(long, value_name = "COLOR")]
    pub(crate) background: Option<Background>,
    /// Light from all around, in pbr shading: a panorama, .hdr or .exr [default: a studio with a key light]
    #[arg(long, value_name = "FILE")]
    pub(crate) environment: Option<PathBuf>,
    /// Which lights shine in pbr shading, beside the light from all around
    #[arg(long, value_enum, default_value = "studio")]
    pub(crate) lights: Lights,
    /// Makes pbr pictures brighter or darker: each step doubles the light
    #[arg(long, value_name = "EV", default_value = "0", value_parser = exposure, allow_negative_numbers = true)]
    pub(crate) exposure: f64,
    /// How light that is brighter than a screen is shown, in pbr shading
    #[arg(long, value_enum, default_value = "neutral")]
    pub(crate) tone_mapping: ToneMapping,
    /// Whether a shadow lies on the ground below the model, in pbr shading
    #[arg(long, value_enum, default_value = "on")]
    pub(crate) ground: Switch,
    /// Whether textures that are seen small are looked up in smaller images; off: bilinearly in the full-size one
    #[arg(long, value_enum, default_value = "on")]
    pub(crate) mipmaps: Switch,
    /// Whether normal textures bend normals, in normals and lambert shading
    #[arg(long, value_enum, default_value = "off")]
    pub(crate) normal_maps: Switch,
    /// Where the model has no normals: smooth them between faces that meet at less than this angle; 0 for flat faces
    /// [default: 40 with pbr, matcap and wireframe shading, else 0]
    #[arg(long, value_name = "DEG", value_parser = crease_angle, allow_negative_numbers = true)]
    pub(crate) smooth: Option<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Shading {
    /// Physically based materials in a photographer's studio, or in light from --environment; anti-aliased
    Pbr,
    /// Base colour, texture and vertex colour without any light; exact, for comparisons
    Unlit,
    /// One distant light; exact, for comparisons
    Lambert,
    /// World-space normals, n * 0.5 + 0.5
    Normals,
    /// Distance along the view axis: 16-bit grey, near 0 to far 65534, and 65535 where nothing is
    Depth,
    /// Object, material and triangle numbers: 16-bit red, green, and blue with 65535 - alpha; see docs/ids-png.md
    Ids,
    /// Texture coordinates: u red, v green, a board of 8 x 8 fields blue
    Uv,
    /// Edges of triangles on a pale surface
    Wireframe,
    /// Clay that was lit once and for all: shapes without materials
    Matcap,
    /// How many fragments a pixel gets without a depth test, as heat: 1 dark blue, 4 purple, 8 red, 16 yellow, 32 and more white
    Overdraw,
    /// How many triangles cover a pixel: 0 black, 1 blue, 2 green, 3 yellow, 4 orange, 5 red, 6 magenta, more white
    Coverage,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Lights {
    /// The studio's key light
    Studio,
    /// The model's own (KHR_lights_punctual), in a dimmed studio; without shadows
    Model,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ToneMapping {
    /// Khronos PBR Neutral: colours stay what they are, highlights fade to white
    Neutral,
    /// The film industry's curve: more contrast
    Aces,
    /// Cut off
    None,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Switch {
    On,
    Off,
}

const EXAMPLES: &str = "\
Examples:
  pineda render -o picture.png                                  the demo scene
  pineda render spot.obj -o spot.png --size 1920x1080 --azimuth 120
  pineda render part.stl -o part.webp --up z --frame tight --background transparent --samples 16
  pineda render fox.gltf -o run.png --animation Run --time 0.4
  pineda render helmet.glb -o helmet.png --environment sunset.hdr --exposure 0.5 --background '#202020'
  pineda render room.glb -o room.jpg --camera 0 --size 1600x900
  pineda render fox.gltf -o depth.exr --shading depth --eye 0,80,250 --look-at 0,40,0

Thumbnails of a folder, 256 pixels each; a second run draws only what is new:
  pineda render models/*.glb --out-dir thumbnails --size 256x256 --frame tight --resume
A report for a script:
  pineda render models/*.glb --out-dir out --json | jq -r '.models[] | select(.error) | .input'
Between two programs:
  curl -s https://example.org/model.glb | pineda render - -o - --picture-format png | display";
