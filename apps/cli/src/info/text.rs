//! What is in a model, for people.

use super::contents::Info;
use std::fmt::{self, Display, Formatter};

/// Of a list, this much is shown; `--json` has all of it.
const SHOWN: usize = 20;

impl Display for Info {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}{}", self.file, self.format.as_ref().map(|name| format!(", {name}")).unwrap_or_default())?;
        let counts = &self.counts;
        for (count, one, many) in [
            (counts.objects, "object", "objects"),
            (counts.triangles, "triangle", "triangles"),
            (counts.lines, "line", "lines"),
            (counts.points, "point", "points"),
            (counts.vertices, "vertex", "vertices"),
        ] {
            if count > 0 {
                writeln!(f, "  {} {}", grouped(count), if count == 1 { one } else { many })?;
            }
        }
        if let Some([min, max]) = self.bounds {
            let [x, y, z] = [0, 1, 2].map(|axis| number(max[axis] - min[axis]));
            writeln!(f, "  {x} x {y} x {z}, from {} to {}", place(min), place(max))?;
        }
        if self.scenes.len() > 1 {
            list(
                f,
                "scenes",
                self.scenes.iter().enumerate().map(|(k, name)| {
                    format!("{}{}", named(name), if k == self.default_scene { " (shown)" } else { "" })
                }),
            )?;
        }
        list(
            f,
            "objects",
            self.objects.iter().map(|object| {
                let mut parts = Vec::new();
                for (count, what) in
                    [(object.triangles, "triangles"), (object.lines, "lines"), (object.points, "points")]
                {
                    if count > 0 {
                        parts.push(format!("{} {what}", grouped(count)));
                    }
                }
                parts.push(format!("material {}", object.material));
                for (is_so, what) in [(!object.has_normals, "no normals"), (object.has_tangents, "tangents")] {
                    if is_so {
                        parts.push(what.to_owned());
                    }
                }
                if object.uv_sets > 0 {
                    parts.push(format!("{} uv", object.uv_sets));
                }
                format!("{}: {}", named(&object.name), parts.join(", "))
            }),
        )?;
        list(
            f,
            "materials",
            self.materials.iter().map(|material| {
                let mut parts = vec![material.alpha.to_owned()];
                if material.double_sided {
                    parts.push("double sided".to_owned());
                }
                if material.textures > 0 {
                    parts.push(format!("textures: {}", material.textures));
                }
                parts.extend(material.extensions.iter().map(|&name| name.to_owned()));
                format!("{}: {}", named(&material.name), parts.join(", "))
            }),
        )?;
        list(
            f,
            "images",
            self.images.iter().map(|image| {
                let [width, height] = image.size;
                format!("{}: {width} x {height}, {} bits", named(&image.name), image.bits)
            }),
        )?;
        let animation = |a: &super::contents::AnimationInfo| format!("{}: {} s", named(&a.name), number(a.seconds));
        list(f, "animations", self.animations.iter().map(animation))?;
        list(f, "variants", self.variants.iter().map(|name| named(name)))?;
        list(
            f,
            "cameras",
            self.cameras.iter().map(|camera| {
                let fov = camera.fov.map(|fov| format!(", {} degrees", number(fov))).unwrap_or_default();
                format!("{}: {}{fov}, at {}", named(&camera.name), camera.kind, place(camera.eye))
            }),
        )?;
        list(
            f,
            "lights",
            self.lights.iter().map(|light| {
                let unit = if light.kind == "directional" { "lx" } else { "cd" };
                format!("{}: {}, {} {unit}", named(&light.name), light.kind, number(light.intensity.into()))
            }),
        )?;
        for note in &self.notes {
            writeln!(f, "note: {note}")?;
        }
        Ok(())
    }
}

/// A heading, and a numbered line for each.
fn list(f: &mut Formatter<'_>, what: &str, lines: impl ExactSizeIterator<Item = String>) -> fmt::Result {
    let count = lines.len();
    if count == 0 {
        return Ok(());
    }
    writeln!(f, "{what}")?;
    for (number, line) in lines.take(SHOWN).enumerate() {
        writeln!(f, "  {number} {line}")?;
    }
    if count > SHOWN {
        writeln!(f, "  and {} more", grouped(count - SHOWN))?;
    }
    Ok(())
}

fn named(name: &str) -> String {
    if name.is_empty() { "(no name)".to_owned() } else { name.to_owned() }
}

/// Four digits that count.
fn number(x: f64) -> String {
    let text = format!("{x:.3e}");
    text.parse::<f64>().map_or(text, |rounded| rounded.to_string())
}

fn place([x, y, z]: [f64; 3]) -> String {
    format!("({}, {}, {})", number(x), number(y), number(z))
}

/// 1,040,409.
fn grouped(count: usize) -> String {
    let digits = count.to_string();
    let mut out = String::new();
    for (k, digit) in digits.chars().enumerate() {
        if k > 0 && (digits.len() - k).is_multiple_of(3) {
            out.push(',');
        }
        out.push(digit);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        assert_eq!([0.0, 1.0, 1234.567, 0.1 + 0.2, -2.0].map(number), ["0", "1", "1235", "0.3", "-2"]);
        assert_eq!([0, 999, 1000, 1_040_409].map(grouped), ["0", "999", "1,000", "1,040,409"]);
    }
}
