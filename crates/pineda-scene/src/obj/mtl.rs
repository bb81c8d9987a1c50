//! MTL material libraries, in glTF's terms.
//!
//! | MTL | becomes |
//! | --- | --- |
//! | `Kd`, `map_Kd` | base colour; read as sRGB, as three.js and Blender do: exporters write the colour of their colour picker |
//! | `d`, `Tr`, `map_d` | alpha, blended |
//! | `Ke`, `map_Ke` | emission |
//! | `Ns` | roughness: the width of Blinn and Phong's highlight (Walter et al. 2007: alpha^2 = 2 / (Ns + 2)) |
//! | `Ks` | the reflection seen head-on: 0.5 is the 4 % of ordinary matter, as Blender writes it |
//! | `Ni` | index of refraction, where it is beyond 1 |
//! | `Pr`, `Pm`, `Pc`, `Pcr`, `map_Pr`, `map_Pm` | roughness, metalness, clearcoat |
//! | `norm`, `map_Bump`, `bump` | normals, if the image has colours: then it is a normal map, whatever its name |

use std::collections::HashMap;

use crate::color::srgb_to_linear;
use crate::text::{Syntax, Text, float, shown};
use crate::{AlphaMode, Clearcoat, Material, Specular};

/// The materials of all libraries that a file names.
#[derive(Default)]
pub(super) struct Library {
    by_name: HashMap<String, Entry>,
    /// Statements without sense, one line each.
    pub(super) notes: Vec<String>,
}

/// A material and the images that it would like.
#[derive(Clone, Debug)]
pub(super) struct Entry {
    pub(super) material: Material,
    /// The folder of its library, for the names of images; empty or ending with a slash.
    pub(super) folder: String,
    pub(super) base_color: Option<Map>,
    pub(super) alpha: Option<Map>,
    pub(super) emissive: Option<Map>,
    pub(super) normal: Option<Map>,
    pub(super) roughness: Option<Map>,
    pub(super) metallic: Option<Map>,
    /// Whether `d` has said how opaque it is: then `Tr`, which exporters disagree about, says nothing.
    has_d: bool,
    /// Whether `Pr` has said how rough it is: then `Ns`, which can say less, says nothing.
    has_pr: bool,
}

/// A line `map_...`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Map {
    /// As it is written.
    pub(super) file: String,
    /// `u * scale + offset`, where v goes up.
    pub(super) scale: [f64; 2],
    pub(super) offset: [f64; 2],
    /// Whether it ends at its border.
    pub(super) clamp: bool,
    /// How strong bumps are.
    pub(super) strength: f64,
}

impl Library {
    pub(super) fn get(&self, name: &str) -> Option<&Entry> {
        self.by_name.get(name)
    }

    /// Adds a library. If two define a material, the first one counts.
    pub(super) fn parse(&mut self, file: &str, bytes: &[u8]) {
        let folder = file.rfind(['/', '\\']).map_or("", |slash| &file[..=slash]);
        let mut text = Text::new(bytes, Syntax::Wavefront);
        let mut current: Option<(String, Entry)> = None;
        let mut nonsense = None;
        loop {
            if let Some(keyword) = text.word() {
                if keyword.eq_ignore_ascii_case(b"newmtl") {
                    self.add(current.take());
                    let name = shown(text.rest());
                    let entry = Entry::new(&name, folder);
                    current = Some((name, entry));
                } else if let Some((_, entry)) = &mut current
                    && statement(keyword, &mut text, entry).is_none()
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

impl Entry {
    fn new(name: &str, folder: &str) -> Self {
        Self {
            material: Material { name: name.into(), ..Material::default() },
            folder: folder.to_owned(),
            base_color: None,
            alpha: None,
            emissive: None,
            normal: None,
            roughness: None,
            metallic: None,
            has_d: false,
            has_pr: false,
        }
    }
}

impl Entry {
    /// Base colour, alpha, emission, normals, roughness, metalness.
    pub(super) fn maps(&self) -> [Option<&Map>; 6] {
        [&self.base_color, &self.alpha, &self.emissive, &self.normal, &self.roughness, &self.metallic]
            .map(Option::as_ref)
    }
}

/// One line of a material; `None` if it makes no sense.
fn statement(keyword: &[u8], text: &mut Text<'_>, entry: &mut Entry) -> Option<()> {
    let material = &mut entry.material;
    match keyword.to_ascii_lowercase().as_slice() {
        b"kd" => material.base_color_factor[..3].copy_from_slice(&color(text)?.map(srgb_to_linear)),
        b"ke" => material.emissive_factor = color(text)?.map(srgb_to_linear),
        b"ks" => {
            let color_factor = color(text)?.map(|c| (2.0 * c) as f32);
            material.specular = Some(Specular { color_factor, ..Specular::default() });
        }
        b"d" => {
            entry.has_d = true;
            set_alpha(material, number(text)?);
        }
        b"tr" if entry.has_d => {}
        b"tr" => set_alpha(material, 1.0 - number(text)?),
        b"ns" if entry.has_pr => {}
        // Roughness is the root of alpha, which is the root of 2 / (Ns + 2).
        b"ns" => material.roughness_factor = (2.0 / (number(text)?.max(0.0) + 2.0)).sqrt().sqrt() as f32,
        b"ni" => {
            let ior = number(text)?;
            material.ior = if ior > 1.0 { ior as f32 } else { material.ior };
        }
        b"pr" => {
            entry.has_pr = true;
            material.roughness_factor = part(text)?;
        }
        b"pm" => material.metallic_factor = part(text)?,
        b"pc" => material.clearcoat.get_or_insert_with(Clearcoat::default).factor = part(text)?,
        b"pcr" => material.clearcoat.get_or_insert_with(Clearcoat::default).roughness_factor = part(text)?,
        b"map_kd" => entry.base_color = Some(map(text)?),
        b"map_d" => entry.alpha = Some(map(text)?),
        b"map_ke" => entry.emissive = Some(map(text)?),
        b"map_pr" => entry.roughness = Some(map(text)?),
        b"map_pm" => entry.metallic = Some(map(text)?),
        b"norm" | b"map_norm" => entry.normal = Some(map(text)?),
        // A normal map by its own name is not overruled.
        b"bump" | b"map_bump" if entry.normal.is_none() => entry.normal = Some(map(text)?),
        _ => {}
    }
    Some(())
}

fn set_alpha(material: &mut Material, alpha: f64) {
    let alpha = alpha.clamp(0.0, 1.0) as f32;
    material.base_color_factor[3] = alpha;
    material.alpha_mode = if alpha < 1.0 { AlphaMode::Blend } else { AlphaMode::Opaque };
}

/// Three numbers; one stands for all three.
fn color(text: &mut Text<'_>) -> Option<[f64; 3]> {
    let first = number(text)?;
    let second = number(text).unwrap_or(first);
    let third = number(text).unwrap_or(second);
    Some([first, second, third])
}

/// A number within 0..=1.
fn part(text: &mut Text<'_>) -> Option<f32> {
    Some(number(text)?.clamp(0.0, 1.0) as f32)
}

/// The next word that is a number, past options such as `-halo`.
fn number(text: &mut Text<'_>) -> Option<f64> {
    let mut word = text.word()?;
    while word.starts_with(b"-") && word.get(1).is_some_and(u8::is_ascii_alphabetic) {
        word = text.word()?;
    }
    float(word).filter(|number| number.is_finite())
}

/// Options, then the name of a file, which may have spaces in it.
fn map(text: &mut Text<'_>) -> Option<Map> {
    let rest = text.rest();
    let mut options = Text::new(rest, Syntax::Wavefront);
    let mut map = Map { file: String::new(), scale: [1.0; 2], offset: [0.0; 2], clamp: false, strength: 1.0 };
    loop {
        let before = options.offset();
        let word = options.word()?;
        match word.to_ascii_lowercase().as_slice() {
            b"-s" => map.scale = pair(&mut options, 1.0),
            b"-o" => map.offset = pair(&mut options, 0.0),
            b"-t" => {
                pair(&mut options, 0.0);
            }
            b"-bm" => map.strength = number(&mut options)?,
            b"-clamp" => map.clamp = options.word()?.eq_ignore_ascii_case(b"on"),
            b"-mm" => {
                options.word()?;
                options.word()?;
            }
            b"-blendu" | b"-blendv" | b"-boost" | b"-cc" | b"-texres" | b"-imfchan" | b"-type" | b"-colorspace" => {
                options.word()?;
            }
            _ => {
                map.file = shown(rest[before..].trim_ascii());
                return Some(map);
            }
        }
    }
}

/// One to three numbers, of which two count.
fn pair(options: &mut Text<'_>, default: f64) -> [f64; 2] {
    let mut pair = [default; 2];
    for place in 0..3 {
        let mut ahead = options.clone();
        let Some(number) = ahead.word().and_then(float).filter(|number| number.is_finite()) else { break };
        *options = ahead;
        if let Some(slot) = pair.get_mut(place) {
            *slot = number;
        }
    }
    pair
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
        let (entry, notes) = only("# x\r\nKa 9 9 9\r\nnewmtl a\r\nKd 1 0.5 0\r\nd 0.25\r\nillum 2");
        assert_eq!(entry.material.base_color_factor, [1.0, srgb_to_linear(0.5), 0.0, 0.25]);
        assert_eq!(entry.material.alpha_mode, AlphaMode::Blend);
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
    fn mtl_reflection() {
        let of = |mtl: &str| only(&format!("newmtl a\n{mtl}")).0.material;
        assert_eq!(of("Ns 0").roughness_factor, 1.0);
        assert_eq!(of("Ns 30").roughness_factor, 0.5);
        assert_eq!(of("Ns -7").roughness_factor, 1.0);
        assert_eq!(of("Ns 30\nPr 0.25\nNs 0").roughness_factor, 0.25);
        assert_eq!(of("Ks 0.5").specular, Some(Specular::default()));
        assert_eq!(of("Ks 0 1 0.25").specular.unwrap().color_factor, [0.0, 2.0, 0.5]);
        assert_eq!((of("Ni 1.33").ior, of("Ni 1").ior, of("").ior), (1.33, 1.5, 1.5));
        assert_eq!((of("Pm 1").metallic_factor, of("Pm 7").metallic_factor, of("").metallic_factor), (1.0, 1.0, 0.0));
        let clearcoat = of("Pc 0.5\nPcr 0.25").clearcoat.unwrap();
        assert_eq!((clearcoat.factor, clearcoat.roughness_factor), (0.5, 0.25));
        assert_eq!(of("Ke 1 0.5 0").emissive_factor, [1.0, srgb_to_linear(0.5), 0.0]);
    }

    #[test]
    fn mtl_maps_and_their_options() {
        let of = |line: &str| only(&format!("newmtl a\nmap_Kd {line}")).0.base_color;
        let plain = Map { file: "a b.png".to_owned(), scale: [1.0; 2], offset: [0.0; 2], clamp: false, strength: 1.0 };
        assert_eq!(of("a b.png  \r"), Some(plain.clone()));
        assert_eq!(of("-s 2 3 4 -o 0.5 a b.png"), Some(Map { scale: [2.0, 3.0], offset: [0.5, 0.0], ..plain.clone() }));
        assert_eq!(of("-clamp on -blendu off -mm 0 1 a b.png"), Some(Map { clamp: true, ..plain.clone() }));
        assert_eq!(of("-bm 0.5 -imfchan m -t 1 1 1 a b.png"), Some(Map { strength: 0.5, ..plain }));
        assert_eq!(of(""), None);
        assert_eq!(of("-s 1 1"), None);
        let file = |mtl: &str| only(&format!("newmtl a\n{mtl}")).0.normal.unwrap().file;
        assert_eq!(file("norm n.png\nmap_Bump b.png"), "n.png");
        assert_eq!(file("bump b.png\nnorm n.png"), "n.png");
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
