//! Values of options, checked where they are read.

use clap::ValueEnum;
use pineda::{MAX_SIZE, Samples};
use std::str::FromStr;

/// Pixels across and down, both in 1 to [`MAX_SIZE`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Size {
    pub(crate) width: u32,
    pub(crate) height: u32,
}

impl Size {
    pub(crate) fn new(width: u32, height: u32) -> Result<Self, String> {
        let sides = 1..=MAX_SIZE;
        if sides.contains(&width) && sides.contains(&height) {
            Ok(Self { width, height })
        } else {
            Err(format!("{width} x {height} pixels cannot be drawn: both sides must lie in 1 to {MAX_SIZE}"))
        }
    }

    pub(crate) fn pixels(self) -> usize {
        self.width as usize * self.height as usize
    }
}

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let side = |text: &str| text.parse::<u32>().ok().filter(|_| text.bytes().all(|b| b.is_ascii_digit()));
        match text.split_once(['x', 'X']).map(|(width, height)| (side(width), side(height))) {
            Some((Some(width), Some(height))) => Self::new(width, height),
            _ => Err("a size is WIDTHxHEIGHT in pixels, such as 1920x1080".to_owned()),
        }
    }
}

/// A number that is neither NaN nor infinite.
pub(crate) fn finite(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        Ok(_) => Err("must be finite".to_owned()),
        Err(_) => Err("is not a number".to_owned()),
    }
}

/// A number above 0.
pub(crate) fn positive(text: &str) -> Result<f64, String> {
    let number = finite(text)?;
    if number > 0.0 { Ok(number) } else { Err("must be above 0".to_owned()) }
}

/// Three numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Vector(pub(crate) [f64; 3]);

impl FromStr for Vector {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers: Result<Vec<f64>, String> = text.split(',').map(|number| finite(number.trim())).collect();
        match numbers.as_deref() {
            Ok(&[x, y, z]) => Ok(Self([x, y, z])),
            _ => Err("is not a place: give three numbers, such as 1,2.5,-3".to_owned()),
        }
    }
}

/// What is upwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Up(pub(crate) [f64; 3]);

impl FromStr for Up {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (sign, axis) = text.strip_prefix('-').map_or((1.0, text), |axis| (-1.0, axis));
        Ok(Self(match axis {
            "x" | "X" => [sign, 0.0, 0.0],
            "y" | "Y" => [0.0, sign, 0.0],
            "z" | "Z" => [0.0, 0.0, sign],
            _ => match text.parse() {
                Ok(Vector(up)) if up != [0.0; 3] => up,
                _ => return Err("is not a direction: give x, y, z, -x, -y, -z, or X,Y,Z".to_owned()),
            },
        }))
    }
}

/// How many samples a pixel has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct SampleCount(pub(crate) Samples);

impl FromStr for SampleCount {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let samples = Samples::ALL.into_iter().find(|samples| samples.count().to_string() == text);
        samples.map(Self).ok_or_else(|| "a pixel has 1, 2, 4, 8 or 16 samples".to_owned())
    }
}

/// A model's format, as it is named on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ModelFormat {
    Obj,
    Stl,
    Ply,
    #[value(name = "3mf")]
    ThreeMf,
    /// glTF, or GLB
    #[value(alias = "glb")]
    Gltf,
}

impl From<ModelFormat> for pineda_scene::Format {
    fn from(format: ModelFormat) -> Self {
        match format {
            ModelFormat::Obj => Self::Obj,
            ModelFormat::Stl => Self::Stl,
            ModelFormat::Ply => Self::Ply,
            ModelFormat::ThreeMf => Self::ThreeMf,
            ModelFormat::Gltf => Self::Gltf,
        }
    }
}

/// Steps of exposure.
pub(crate) fn exposure(text: &str) -> Result<f64, String> {
    let steps = finite(text)?;
    if (-32.0..=32.0).contains(&steps) { Ok(steps) } else { Err("must lie in -32 to 32".to_owned()) }
}

/// A field of view in degrees.
pub(crate) fn field_of_view(text: &str) -> Result<f64, String> {
    let degrees = finite(text)?;
    if (0.1..=179.0).contains(&degrees) { Ok(degrees) } else { Err("must lie in 0.1 to 179 degrees".to_owned()) }
}

/// A crease angle in degrees.
pub(crate) fn crease_angle(text: &str) -> Result<f64, String> {
    let degrees = finite(text)?;
    if (0.0..=180.0).contains(&degrees) { Ok(degrees) } else { Err("must lie in 0 to 180 degrees".to_owned()) }
}

/// What is behind the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Background {
    Transparent,
    /// A photographer's paper sweep: a soft, light gradient.
    Studio,
    /// sRGB codes.
    Color([u8; 3]),
}

impl FromStr for Background {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || "is not a background: give transparent, studio, black, white, gray, #rgb or #rrggbb".to_owned();
        Ok(match text {
            "transparent" | "none" => Self::Transparent,
            "studio" => Self::Studio,
            "black" => Self::Color([0; 3]),
            "white" => Self::Color([255; 3]),
            "gray" | "grey" => Self::Color([128; 3]),
            _ => {
                let digits = text.strip_prefix('#').unwrap_or(text);
                let digits: Option<Vec<u8>> = digits.chars().map(|c| c.to_digit(16).map(|digit| digit as u8)).collect();
                match digits.ok_or_else(wrong)?[..] {
                    [r, g, b] => Self::Color([r, g, b].map(|digit| digit * 17)),
                    [r, r2, g, g2, b, b2] => Self::Color([r * 16 + r2, g * 16 + g2, b * 16 + b2]),
                    _ => return Err(wrong()),
                }
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_of_size() {
        assert_eq!("1920x1080".parse(), Ok(Size { width: 1920, height: 1080 }));
        assert_eq!("16384X1".parse(), Ok(Size { width: 16384, height: 1 }));
        for wrong in [
            "",
            "0",
            "0x10",
            "10x0",
            "20000x20000",
            "10",
            "10x",
            "x10",
            "-1x5",
            "+1x5",
            "1.5x2",
            "99999999999x1",
            "1x2x3",
        ] {
            assert!(wrong.parse::<Size>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn values_of_angles() {
        assert_eq!(field_of_view("40"), Ok(40.0));
        for wrong in ["0", "180", "-1", "NaN", "inf", "x", ""] {
            assert!(field_of_view(wrong).is_err(), "{wrong}");
        }
        assert_eq!(crease_angle("0"), Ok(0.0));
        assert!(crease_angle("181").is_err() && crease_angle("-0.1").is_err() && crease_angle("nan").is_err());
        assert!(finite("1e999").is_err());
    }

    #[test]
    fn values_of_directions_and_places() {
        assert_eq!("1,-2.5,3e2".parse(), Ok(Vector([1.0, -2.5, 300.0])));
        assert_eq!("-z".parse(), Ok(Up([0.0, 0.0, -1.0])));
        assert_eq!("0,1,1".parse(), Ok(Up([0.0, 1.0, 1.0])));
        for wrong in ["", "1,2", "1,2,3,4", "1,2,x", "NaN,0,0", "inf,0,0"] {
            assert!(wrong.parse::<Vector>().is_err(), "{wrong}");
            assert!(wrong.parse::<Up>().is_err(), "{wrong}");
        }
        assert!("0,0,0".parse::<Up>().is_err() && "w".parse::<Up>().is_err());
        assert!(positive("0").is_err() && positive("-1").is_err() && positive("0.5") == Ok(0.5));
    }

    #[test]
    fn values_of_samples() {
        assert_eq!("16".parse(), Ok(SampleCount(Samples::Sixteen)));
        for wrong in ["0", "3", "32", "04", "-1", ""] {
            assert!(wrong.parse::<SampleCount>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn values_of_background() {
        assert_eq!("#f80".parse(), Ok(Background::Color([255, 136, 0])));
        assert_eq!("#FF8001".parse(), Ok(Background::Color([255, 128, 1])));
        assert_eq!("transparent".parse(), Ok(Background::Transparent));
        for wrong in ["", "#", "#ff", "#12345g", "puce", "#é12"] {
            assert!(wrong.parse::<Background>().is_err(), "{wrong}");
        }
    }
}
