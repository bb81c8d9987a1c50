//! `pineda raster`'s options.

use crate::picture::PictureFormat;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// Draws the triangles of a JSON file in raster space, NDC or clip space
///
/// The file names a size, a space, vertices and triangles; without a file it draws tutorial 1's own triangle, 512 x 512.
#[derive(Args, Debug)]
#[command(after_help = RASTER_EXAMPLES, after_long_help = RASTER_LONG_HELP, args_override_self = true)]
pub(crate) struct RasterArguments {
    /// The triangles, as JSON
    #[arg(value_name = "FILE.json")]
    pub(crate) file: Option<PathBuf>,
    /// The picture: .png, .jpg, .webp, or .ppm as in tutorial 1; - writes to standard output
    #[arg(short, long, value_name = "OUT")]
    pub(crate) output: PathBuf,
    /// What the picture is, whatever its name says; needed for -o -
    #[arg(long, value_enum, value_name = "FORMAT")]
    pub(crate) picture_format: Option<PictureFormat>,
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
