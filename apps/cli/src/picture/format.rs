//! Which formats there are, and what each can hold.

use crate::failure::Failure;
use clap::ValueEnum;
use std::path::Path;

/// A file format of pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum PictureFormat {
    Png,
    #[value(alias = "jpg")]
    Jpeg,
    /// Lossless
    Webp,
    /// Linear light as 32-bit floats
    Exr,
    Ppm,
}

impl PictureFormat {
    /// By the extension of what is written to.
    pub(crate) fn of(path: &Path) -> Result<Self, Failure> {
        let extension = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
        match extension.as_deref() {
            Some("png") => Ok(Self::Png),
            Some("jpg" | "jpeg") => Ok(Self::Jpeg),
            Some("webp") => Ok(Self::Webp),
            Some("exr") => Ok(Self::Exr),
            Some("ppm") => Ok(Self::Ppm),
            _ => {
                let names =
                    "a picture is written as .png, .jpg, .webp, .exr or .ppm, and this name ends in none of them";
                Err(Failure::usage(names)
                    .at(format_args!("-o {}", path.display()))
                    .help("name it picture.png, or say --picture-format png"))
            }
        }
    }

    /// For names that are made here.
    pub(crate) fn extension(self) -> &'static str {
        match self {
            Self::Png => "png",
            Self::Jpeg => "jpg",
            Self::Webp => "webp",
            Self::Exr => "exr",
            Self::Ppm => "ppm",
        }
    }

    /// Whether it holds floats.
    pub(crate) fn is_float(self) -> bool {
        self == Self::Exr
    }

    /// Whether it holds a grey of 16 bits exactly.
    pub(crate) fn has_16_bits(self) -> bool {
        matches!(self, Self::Png | Self::Exr | Self::Ppm)
    }
}
