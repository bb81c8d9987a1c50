//! Which of the pictures that a model holds is wanted.

use crate::Error;
use std::sync::Arc;

/// Scene, time and variant. The default is the file's own scene as it is stored, without animation.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pose {
    /// `None`: the file's default scene.
    pub scene: Option<Select>,
    /// `None`: nodes, morph weights and skins as stored.
    pub animation: Option<Select>,
    /// In seconds from the animation's beginning; before its first and after its last key, those count. Of no meaning
    /// without an animation.
    pub time: f64,
    /// `None`: each primitive's own material (KHR_materials_variants).
    pub variant: Option<Select>,
    /// Leaves materials without textures, and images undecoded: for whoever shows shapes alone. Default `false`.
    pub without_textures: bool,
}

/// One of several things in a file.
///
/// A text is a name; if nothing has that name and the text is a number, it is the number, as command lines want it.
///
/// ```
/// use pineda_scene::Select;
///
/// assert_eq!(Select::from("Walk"), Select::Name("Walk".to_owned()));
/// assert_eq!(Select::from(2), Select::Number(2));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Select {
    /// Its place in the file's list, from 0.
    Number(usize),
    /// Its name; the first that has it.
    Name(String),
}

impl From<usize> for Select {
    fn from(number: usize) -> Self {
        Self::Number(number)
    }
}

impl From<&str> for Select {
    fn from(name: &str) -> Self {
        Self::Name(name.to_owned())
    }
}

impl From<String> for Select {
    fn from(name: String) -> Self {
        Self::Name(name)
    }
}

impl Select {
    /// The number of what is selected among things with these names.
    ///
    /// # Errors
    /// [`Error::NoSuch`] with `what` and the names that there are.
    pub fn among(&self, what: &'static str, names: &[Arc<str>]) -> Result<usize, Error> {
        let found = match self {
            Self::Number(number) => Some(*number),
            Self::Name(name) => names.iter().position(|n| **n == **name).or_else(|| name.parse().ok()),
        };
        found.filter(|&number| number < names.len()).ok_or_else(|| Error::NoSuch {
            what,
            asked: match self {
                Self::Number(number) => number.to_string(),
                Self::Name(name) => format!("'{}'", crate::text::shown(name.as_bytes())),
            },
            there: names.iter().map(|name| name.to_string()).collect(),
        })
    }
}
