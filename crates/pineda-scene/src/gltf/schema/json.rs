//! Pieces of JSON that the schema is made of.

use std::cell::Cell;
use std::collections::HashMap;
use std::fmt;
use std::marker::PhantomData;
use std::ops::{Deref, DerefMut};

use serde::de::{self, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};

use crate::Limits;

/// A whole number that is not negative: an index, a count, an offset. Some exporters write 3.0 for 3.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub(in crate::gltf) struct Whole(pub(in crate::gltf) u64);

impl Whole {
    pub(in crate::gltf) fn index(self) -> usize {
        usize::try_from(self.0).unwrap_or(usize::MAX)
    }
}

impl fmt::Display for Whole {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl<'de> Deserialize<'de> for Whole {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct WholeVisitor;
        impl Visitor<'_> for WholeVisitor {
            type Value = Whole;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a whole number that is not negative")
            }

            fn visit_u64<E: de::Error>(self, number: u64) -> Result<Whole, E> {
                Ok(Whole(number))
            }

            fn visit_f64<E: de::Error>(self, number: f64) -> Result<Whole, E> {
                let whole = number as u64;
                if whole as f64 == number {
                    Ok(Whole(whole))
                } else {
                    Err(E::invalid_value(de::Unexpected::Float(number), &self))
                }
            }
        }
        deserializer.deserialize_any(WholeVisitor)
    }
}

thread_local! {
    /// Bytes that lists may still take in memory, of the text that this thread parses: parsers know nothing but the text.
    static BYTES_LEFT: Cell<usize> = const { Cell::new(Limits::JSON_BYTES) };
}

/// Sets what the lists of a text of so many bytes may take.
pub(in crate::gltf) fn allow_lists(text: usize) {
    BYTES_LEFT.set(text.saturating_mul(8).saturating_add(Limits::JSON_BYTES));
}

fn take_bytes(bytes: usize) -> Result<(), String> {
    let left = BYTES_LEFT.get().checked_sub(bytes);
    let too_many = || "lists that take too many bytes in memory for so short a text (Limits::JSON_BYTES)".to_owned();
    left.map(|left| BYTES_LEFT.set(left)).ok_or_else(too_many)
}

/// A list of at most [`Limits::JSON_LIST`] elements.
#[derive(Debug)]
pub(in crate::gltf) struct List<T>(Vec<T>);

impl<T> Default for List<T> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<T> Deref for List<T> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        &self.0
    }
}

impl<T> DerefMut for List<T> {
    fn deref_mut(&mut self) -> &mut [T] {
        &mut self.0
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for List<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct ListVisitor<T>(PhantomData<T>);
        impl<'de, T: Deserialize<'de>> Visitor<'de> for ListVisitor<T> {
            type Value = List<T>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a list")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut elements: A) -> Result<List<T>, A::Error> {
                let mut list = Vec::new();
                while let Some(element) = elements.next_element()? {
                    take_bytes(size_of::<T>()).map_err(de::Error::custom)?;
                    if list.len() == Limits::JSON_LIST {
                        let message = format!("a list of more than {} elements (Limits::JSON_LIST)", Limits::JSON_LIST);
                        return Err(de::Error::custom(message));
                    }
                    list.push(element);
                }
                Ok(List(list))
            }
        }
        deserializer.deserialize_seq(ListVisitor(PhantomData))
    }
}

/// A primitive's attributes, or a morph target's: which accessor has which, by the semantic's name.
///
/// Names are open-ended (TEXCOORD_0, TEXCOORD_1, ..., and an application's own), so this is a list; a later one of the
/// same name counts.
#[derive(Debug, Default)]
pub(in crate::gltf) struct Attributes(HashMap<Semantic, Whole>);

/// What an attribute means.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(in crate::gltf) enum Semantic {
    Position,
    Normal,
    Tangent,
    TexCoord(u8),
    Color(u8),
    Joints(u8),
    Weights(u8),
}

impl Semantic {
    /// `None` for an application's own attribute, and for sets beyond what anybody looks at.
    fn named(name: &str) -> Option<Self> {
        let numbered = |prefix: &str| name.strip_prefix(prefix).and_then(|set| set.parse().ok());
        match name {
            "POSITION" => Some(Self::Position),
            "NORMAL" => Some(Self::Normal),
            "TANGENT" => Some(Self::Tangent),
            _ => (numbered("TEXCOORD_").map(Self::TexCoord))
                .or_else(|| numbered("COLOR_").map(Self::Color))
                .or_else(|| numbered("JOINTS_").map(Self::Joints))
                .or_else(|| numbered("WEIGHTS_").map(Self::Weights)),
        }
    }
}

impl fmt::Display for Semantic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Position => f.write_str("POSITION"),
            Self::Normal => f.write_str("NORMAL"),
            Self::Tangent => f.write_str("TANGENT"),
            Self::TexCoord(set) => write!(f, "TEXCOORD_{set}"),
            Self::Color(set) => write!(f, "COLOR_{set}"),
            Self::Joints(set) => write!(f, "JOINTS_{set}"),
            Self::Weights(set) => write!(f, "WEIGHTS_{set}"),
        }
    }
}

impl Attributes {
    /// The accessor of an attribute.
    pub(in crate::gltf) fn get(&self, semantic: Semantic) -> Option<Whole> {
        self.0.get(&semantic).copied()
    }

    pub(in crate::gltf) fn iter(&self) -> impl Iterator<Item = (Semantic, Whole)> {
        self.0.iter().map(|(&semantic, &accessor)| (semantic, accessor))
    }
}

impl<'de> Deserialize<'de> for Attributes {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct AttributesVisitor;
        impl<'de> Visitor<'de> for AttributesVisitor {
            type Value = Attributes;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an object of attributes")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Attributes, A::Error> {
                let mut attributes = HashMap::new();
                while let Some(name) = entries.next_key::<String>()? {
                    match Semantic::named(&name) {
                        Some(semantic) => {
                            attributes.insert(semantic, entries.next_value()?);
                        }
                        None => {
                            entries.next_value::<IgnoredAny>()?;
                        }
                    }
                }
                Ok(Attributes(attributes))
            }
        }
        deserializer.deserialize_map(AttributesVisitor)
    }
}
