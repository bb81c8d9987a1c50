//! What the options amount to together, the same for every model.

use crate::arguments::{Lights, RenderArguments, Shading, Switch, ToneMapping};
use crate::failure::Failure;
use crate::picture::PictureFormat;
use crate::values::{Background, Size};
use pineda::Samples;
use pineda_looks::Textures;
use pineda_looks::pbr::{self, PbrSettings};
use pineda_scene::{Pose, Select};

/// The angle up to which faces are smoothed into each other in the looks made for people, in degrees.
const DEFAULT_CREASE: f64 = 40.0;

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Plan {
    pub(crate) shading: Shading,
    pub(crate) format: PictureFormat,
    pub(crate) size: Size,
    pub(crate) samples: Samples,
    pub(crate) background: Background,
    pub(crate) textures: Textures,
    /// Of [`Shading::Pbr`].
    pub(crate) pbr: PbrSettings,
    /// 0 for flat faces.
    pub(crate) crease: f64,
    pub(crate) pose: Pose,
    /// Of JPEGs.
    pub(crate) quality: u8,
}

impl Shading {
    /// Whether it is to be looked at rather than measured.
    fn is_for_people(self) -> bool {
        matches!(self, Self::Pbr | Self::Matcap | Self::Wireframe)
    }

    /// Whether pixels are numbers that must not be mixed, with neighbours or with a background.
    fn is_exact(self) -> bool {
        matches!(self, Self::Depth | Self::Ids | Self::Overdraw | Self::Coverage)
    }
}

impl Plan {
    pub(crate) fn new(arguments: &RenderArguments, format: PictureFormat) -> Result<Self, Failure> {
        let look = &arguments.look;
        let shading = look.shading;
        let samples = match look.samples {
            Some(samples) => samples.0,
            None if shading.is_for_people() => Samples::Four,
            None => Samples::One,
        };
        if shading.is_exact() && samples != Samples::One {
            return Err(Failure::usage("this shading shows numbers: pixels are not mixed of several samples")
                .at("--samples")
                .help("leave --samples away"));
        }
        if shading.is_exact() && look.background.is_some() {
            return Err(Failure::usage("this shading shows numbers: it has no background")
                .at("--background")
                .help("leave --background away"));
        }
        let held = match shading {
            Shading::Ids => matches!(format, PictureFormat::Png | PictureFormat::Exr),
            Shading::Depth => format.has_16_bits(),
            _ => true,
        };
        if !held {
            let what = if shading == Shading::Ids { "ids are four numbers of 16 bits" } else { "depth has 16 bits" };
            return Err(Failure::usage(format_args!("{what}: this format cannot hold them"))
                .at(format_args!("the picture's format, .{}", format.extension()))
                .help("write a .png, or an .exr"));
        }
        Ok(Self {
            shading,
            format,
            size: look.size,
            samples,
            background: background(look.background, shading, format)?,
            textures: Textures { mipmaps: look.mipmaps == Switch::On, normal_maps: look.normal_maps == Switch::On },
            pbr: PbrSettings {
                samples,
                exposure: libm::exp2(look.exposure) as f32,
                tone_mapping: match look.tone_mapping {
                    ToneMapping::Neutral => pbr::ToneMapping::Neutral,
                    ToneMapping::Aces => pbr::ToneMapping::Aces,
                    ToneMapping::None => pbr::ToneMapping::None,
                },
                own_lights: look.lights == Lights::Model,
                ground: look.ground == Switch::On,
                mipmaps: look.mipmaps == Switch::On,
                ..PbrSettings::default()
            },
            crease: look.smooth.unwrap_or(if shading.is_for_people() { DEFAULT_CREASE } else { 0.0 }),
            pose: pose(arguments),
            quality: arguments.files.quality,
        })
    }
}

fn background(asked: Option<Background>, shading: Shading, format: PictureFormat) -> Result<Background, Failure> {
    if asked == Some(Background::Transparent) && format == PictureFormat::Jpeg {
        return Err(Failure::usage("JPEGs cannot be transparent")
            .at("--background transparent")
            .help("give another background, or write a .png or .webp"));
    }
    Ok(match asked {
        Some(background) => background,
        None if shading == Shading::Pbr => Background::Studio,
        None if format == PictureFormat::Jpeg => Background::Color([255; 3]),
        None => Background::Transparent,
    })
}

fn pose(arguments: &RenderArguments) -> Pose {
    let asked = &arguments.pose;
    let select = |name: &Option<String>| name.as_ref().map(|name| Select::from(name.as_str()));
    let animation = select(&asked.animation).or(asked.time.map(|_| Select::Number(0)));
    Pose {
        scene: select(&asked.scene),
        animation,
        time: asked.time.unwrap_or(0.0),
        variant: select(&asked.variant),
        // Edges are edges, whatever is cut out of the surface.
        without_textures: arguments.look.shading == Shading::Wireframe,
    }
}
