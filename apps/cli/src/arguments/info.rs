//! `pineda info`'s options.

use crate::values::ModelFormat;
use clap::Args;
use std::path::PathBuf;

/// Says what is in a model: scenes, objects, materials, textures, animations, cameras, lights
///
/// What is counted is what a picture of the model's own scene would show. Notes name what was left out.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES, args_override_self = true)]
pub(crate) struct InfoArguments {
    /// The model: .obj, .stl, .ply, .3mf, .gltf or .glb; - reads standard input
    #[arg(value_name = "MODEL")]
    pub(crate) model: PathBuf,
    /// What the model is, whatever its name says
    #[arg(long, value_enum, value_name = "FORMAT")]
    pub(crate) model_format: Option<ModelFormat>,
    /// Prints JSON, for programs
    #[arg(long)]
    pub(crate) json: bool,
}

const EXAMPLES: &str = "\
Examples:
  pineda info fox.gltf
  pineda info fox.gltf --json | jq '.animations[].name'
  curl -s https://example.org/model.glb | pineda info -";
