//! The command line, declared.

use crate::failure::Failure;
use crate::values::{Background, Size, crease_angle, field_of_view, finite};
use clap::{Args, Parser, Subcommand, ValueEnum};
use pineda::{Renderer, Settings, Simd};
use std::path::PathBuf;

/// Draws triangles and 3D models on the CPU, every pixel exact, the same on every machine.
#[derive(Debug, Parser)]
#[command(name = "pineda", version, about, after_help = EXAMPLES, propagate_version = true, disable_help_subcommand = true)]
pub(crate) struct Arguments {
    #[command(flatten)]
    pub(crate) how: How,
    #[command(subcommand)]
    pub(crate) command: Command,
}

const EXAMPLES: &str = "\
Examples:
  pineda render -o picture.png               the demo scene
  pineda render model.glb -o model.png       a model: OBJ, STL, PLY, glTF, GLB
  pineda raster -o triangle.ppm              the tutorials' triangle

`pineda render --help` and `pineda raster --help` say more.
Exit codes: 0 done, 1 a file or the machine is at fault, 2 bad usage. On failure no file is written.";

/// How to draw; changes no pixel.
#[derive(Args, Debug)]
#[command(next_help_heading = "How to draw (changes no pixel)")]
pub(crate) struct How {
    /// Threads to draw with [default: one per core]
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    threads: Option<u16>,
    /// Vector instructions to use: auto, scalar, sse2, sse4.2, avx2, avx512 or neon
    #[arg(long, global = true, value_name = "LEVEL", default_value = "auto", hide_default_value = true)]
    simd: Simd,
}

impl How {
    pub(crate) fn renderer(&self) -> Result<Renderer, Failure> {
        let settings =
            Settings { simd: self.simd, threads: self.threads.map_or(0, usize::from), ..Settings::default() };
        Ok(Renderer::new(settings)?)
    }
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Raster(RasterArguments),
    Render(RenderArguments),
}

/// Draws the triangles of a JSON file in raster space, NDC or clip space
///
/// The file names a size, a space, vertices and triangles; without a file it draws tutorial 1's own triangle, 512 x 512.
#[derive(Args, Debug)]
#[command(after_help = RASTER_EXAMPLES, after_long_help = RASTER_LONG_HELP, args_override_self = true)]
pub(crate) struct RasterArguments {
    /// The triangles, as JSON
    #[arg(value_name = "FILE.json")]
    pub(crate) file: Option<PathBuf>,
    /// The picture: .png, or .ppm as in tutorial 1
    #[arg(short, long, value_name = "OUT.{png,ppm}")]
    pub(crate) output: PathBuf,
    /// What to show of each pixel
    #[arg(long, value_enum, default_value = "colour")]
    pub(crate) show: Show,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Show {
    /// The vertices' colours, interpolated: plain 8-bit values
    #[value(alias = "color")]
    Colour,
    /// How many triangles cover it: 0 black, 1 blue, 2 green, 3 yellow, 4 orange, 5 red, 6 magenta, more white
    Count,
    /// Its barycentric coordinates in the triangle it shows, as red, green and blue
    Barycentric,
    /// Its depth: 16-bit grey, round(depth * 65534), and 65535 where nothing is
    Depth,
    /// The number of the triangle it shows, plus 1, its bits dealt to red, green, blue from the brightest on
    Id,
}

const RASTER_EXAMPLES: &str = "\
Examples:
  pineda raster -o raster2d.ppm                         tutorial 1's triangle
  pineda raster quad.json -o quad.png --show count      no pixel of a shared edge is drawn twice";

const RASTER_LONG_HELP: &str = r#"Examples:
  pineda raster -o raster2d.ppm                         tutorial 1's triangle
  pineda raster quad.json -o quad.png --show count      no pixel of a shared edge is drawn twice

The file:
  {
    "size": [512, 512],                     pixels across and down
    "space": "raster",                      "raster" (default), "ndc" or "clip"
    "vertices": [
      { "position": [491.407, 411.407], "color": [1, 0, 0] },
      { "position": [148.593, 68.5928], "color": [0, 1, 0] },
      { "position": [148.593, 411.407], "color": [0, 0, 1] }
    ],
    "triangles": [[0, 1, 2]],               default: every three vertices in turn
    "cull": "none",                         "none" (default), "front" or "back"
    "front_face": "counter-clockwise",      or "clockwise", as seen on the picture
    "depth_test": true,                     default: if any vertex has a depth
    "background": [0, 0, 0]                 default: black
  }
  raster  x right and y down in pixels, from the top-left corner; depth 0 (near) to 1; w the eye distance
  ndc     x right and y up, -1 to 1; depth 0 to 1; w the eye distance
  clip    homogeneous: x right, y up, seen where -w <= x, y <= w and 0 <= z <= w; w may be 0 or less
A position is [x, y], [x, y, z] or [x, y, z, w]; "depth" and "w" may stand by themselves instead.
Depth is 0 and w is 1 where not given. A color is [r, g, b] or [r, g, b, a], 0 to 1; white where not given.
docs/raster-json.md has the whole of it."#;

/// Draws a model, or without one a demo scene, in a three-quarter view
///
/// Reads OBJ, STL (ASCII, binary), PLY (ASCII, binary), glTF and GLB. The whole model is in the picture.
#[derive(Args, Debug)]
#[command(after_help = RENDER_EXAMPLES, args_override_self = true)]
pub(crate) struct RenderArguments {
    /// The model: .obj, .stl, .ply, .gltf or .glb
    #[arg(value_name = "MODEL")]
    pub(crate) model: Option<PathBuf>,
    /// The picture: .png, or .ppm
    #[arg(short, long, value_name = "OUT.{png,ppm}")]
    pub(crate) output: PathBuf,
    /// Pixels across and down
    #[arg(long, value_name = "WxH", default_value = "1024x1024")]
    pub(crate) size: Size,
    /// Degrees around the model, from its front (+z) towards its left (+x)
    #[arg(long, value_name = "DEG", default_value = "30", value_parser = finite, allow_negative_numbers = true)]
    pub(crate) azimuth: f64,
    /// Degrees above the horizon
    #[arg(long, value_name = "DEG", default_value = "20", value_parser = finite, allow_negative_numbers = true)]
    pub(crate) elevation: f64,
    /// Vertical field of view in degrees, 0.1 to 179
    #[arg(long, value_name = "DEG", default_value = "40", value_parser = field_of_view, allow_negative_numbers = true)]
    pub(crate) fov: f64,
    /// What to show of the surface
    #[arg(long, value_enum, default_value = "studio")]
    pub(crate) shading: Shading,
    /// transparent, studio, black, white, gray, #rgb or #rrggbb [default: studio with studio shading, else transparent]
    #[arg(long, value_name = "COLOR")]
    pub(crate) background: Option<Background>,
    /// Samples a pixel: 1 (no anti-aliasing), 4 or 16; for studio shading [default: 4 there, else 1]
    #[arg(long, value_name = "N", value_parser = ["1", "4", "16"])]
    pub(crate) samples: Option<String>,
    /// Where the model has no normals: smooth them between faces that meet at less than this angle; 0 for flat faces
    /// [default: 40 with studio shading, else 0]
    #[arg(long, value_name = "DEG", value_parser = crease_angle, allow_negative_numbers = true)]
    pub(crate) smooth: Option<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Shading {
    /// Soft studio light, anti-aliased
    Studio,
    /// One distant light; exact, for comparisons
    Lambert,
    /// World-space normals, n * 0.5 + 0.5
    Normals,
    /// Distance along the view axis: 16-bit grey, near 0 to far 65534, and 65535 where nothing is
    Depth,
    /// Object, material and triangle numbers: 16-bit red, green, and blue with 65535 - alpha; see docs/ids-png.md
    Ids,
}

const RENDER_EXAMPLES: &str = "\
Examples:
  pineda render -o picture.png
  pineda render spot.obj -o spot.png --size 1920x1080 --azimuth 120
  pineda render part.stl -o part.png --background transparent --samples 16
  pineda render fox.gltf -o depth.png --shading depth --fov 25";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arguments_are_declared_consistently() {
        use clap::CommandFactory;
        Arguments::command().debug_assert();
    }
}
