//! MTL material libraries: the diffuse colour and the opacity.
//!
//! `Kd` is read as sRGB, as three.js and Blender do: exporters write the colour of their colour picker.

use std::collections::HashMap;

use crate::color::srgb_to_linear;
use crate::text::{Syntax, Text, float, shown};
use crate::{AlphaMode, Material};

/// The materials of all libraries that a file names.
#[derive(Default)]
pub(super) struct Library {
    by_name: HashMap<String, Entry>,
    /// Statements without sense, one line each.
    pub(super) notes: Vec<String>,
}

/// A material and how many textures it would like.
#[derive(Clone)]
pub(super) struct Entry {
    pub(super) material: Material,
    pub(super) textures: usize,
    /// Whether `d` has said how opaque it is: then `Tr`, which exporters disagree about, says nothing.
    has_d: bool,
}

impl Library {
    pub(super) fn get(&self, name: &str) -> Option<&Entry> {
        self.by_name.get(name)
    }

    /// Adds a library. If two define a material, the first one counts.
    pub(super) fn parse(&mut self, file: &str, bytes: &[u8]) {
        let mut text = Text::new(bytes, Syntax::Wavefront);
        let mut current: Option<(String, Entry)> = None;
        let mut nonsense = None;
        loop {
            if let Some(keyword) = text.word() {
                if keyword.eq_ignore_ascii_case(b"newmtl") {
                    self.add(current.take());
                    let name = shown(text.rest());
                    let material = Material { name: name.as_str().into(), ..Material::default() };
                    current = Some((name, Entry { material, textures: 0, has_d: false }));
                } else if let Some((_, entry)) = &mut current
                    && !statement(keyword, &mut text, entry)
                {
                    nonsense = nonsense.or(Some(text.line()));
                }
            }
            if !text.next_line() {
                break;
            }
        }
        self.add(current);
        if let Some(line) = nonsense {
            self.notes.push(format!("material library '{file}', line {line}: not understood, left out"));
        }
    }

    fn add(&mut self, entry: Option<(String, Entry)>) {
        if let Some((name, entry)) = entry {
            self.by_name.entry(name).or_insert(entry);
        }
    }
}

/// One line of a material; `false` if it makes no sense.
fn statement(keyword: &[u8], text: &mut Text<'_>, entry: &mut Entry) -> bool {
    let color = &mut entry.material.base_color_factor;
    let alpha = match keyword.to_ascii_lowercase().as_slice() {
        b"kd" => {
            let Some(first) = number(text) else { return false };
            // One number stands for all three.
            let second = number(text).unwrap_or(first);
            let third = number(text).unwrap_or(second);
            color[..3].copy_from_slice(&[first, second, third].map(srgb_to_linear));
            return true;
        }
        b"d" => {
            entry.has_d = true;
            number(text)
        }
        b"tr" if entry.has_d => return true,
        b"tr" => number(text).map(|transparency| 1.0 - transparency),
        keyword => {
            entry.textures += usize::from(keyword.starts_with(b"map_"));
            return true;
        }
    };
    let Some(alpha) = alpha else { return false };
    color[3] = alpha.clamp(0.0, 1.0) as f32;
    entry.material.alpha_mode = if color[3] < 1.0 { AlphaMode::Blend } else { AlphaMode::Opaque };
    true
}

/// The next word that is a number, past options such as `-halo`.
fn number(text: &mut Text<'_>) -> Option<f64> {
    let mut word = text.word()?;
    while word.starts_with(b"-") && word.get(1).is_some_and(u8::is_ascii_alphabetic) {
        word = text.word()?;
    }
    float(word).filter(|number| number.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn only(mtl: &str) -> (Entry, Vec<String>) {
        let mut library = Library::default();
        library.parse("a.mtl", mtl.as_bytes());
        (library.get("a").unwrap().clone(), library.notes)
    }

    #[test]
    fn mtl_colour_and_opacity() {
        let (entry, notes) =
            only("# x\r\nKa 9 9 9\r\nnewmtl a\r\nKd 1 0.5 0\r\nd 0.25\r\nmap_Kd -s 1 1 1 t.png\r\nillum 2");
        assert_eq!(entry.material.base_color_factor, [1.0, srgb_to_linear(0.5), 0.0, 0.25]);
        assert_eq!((entry.material.alpha_mode, entry.textures), (AlphaMode::Blend, 1));
        assert_eq!(&*entry.material.name, "a");
        assert!(notes.is_empty());
        assert_eq!(only("newmtl a\nTr 0.75").0.material.base_color_factor, [1.0, 1.0, 1.0, 0.25]);
        for both in ["newmtl a\nd 1\nTr 1", "newmtl a\nTr 1\nd 1"] {
            assert_eq!(only(both).0.material.base_color_factor[3], 1.0);
        }
        assert_eq!(only("newmtl a\nd -halo 0.5").0.material.base_color_factor[3], 0.5);
        assert_eq!(only("newmtl a\nKd 0").0.material.base_color_factor, [0.0, 0.0, 0.0, 1.0]);
        assert_eq!(only("newmtl a\nd 1").0.material.alpha_mode, AlphaMode::Opaque);
    }

    #[test]
    fn mtl_nonsense_is_a_note() {
        let (entry, notes) = only("newmtl a\nKd spectral x.rfl\nd nan\n");
        assert_eq!(entry.material.base_color_factor, [1.0; 4]);
        assert_eq!(notes, ["material library 'a.mtl', line 2: not understood, left out"]);
    }

    #[test]
    fn mtl_first_definition_counts() {
        assert_eq!(only("newmtl a\nKd 0 0 0\nnewmtl a\nKd 1 1 1").0.material.base_color_factor[0], 0.0);
    }
}
