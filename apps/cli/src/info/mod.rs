//! `pineda info`: what is in a model.

mod contents;
mod text;

use crate::arguments::InfoArguments;
use crate::failure::Failure;
use crate::render::model;
use contents::Info;
use std::io::Write;

pub(crate) fn run(arguments: &InfoArguments) -> Result<(), Failure> {
    let model = model(&arguments.model, arguments.model_format)?;
    let info = Info::of(&model, &arguments.model)?;
    let text = if arguments.json {
        let json = serde_json::to_string_pretty(&info);
        json.map_err(|error| Failure::data(format_args!("no report could be made: {error}")))? + "\n"
    } else {
        info.to_string()
    };
    let written = std::io::stdout().write_all(text.as_bytes());
    written.map_err(|error| Failure::data(format_args!("standard output cannot be written: {error}")))
}
