//! The last step of every reader: what a renderer could not draw is taken out.

use crate::load::Loaded;
use crate::note::counted;
use crate::vector::{add, area_vector_x2, unit_or_zero, widen};
use crate::{Normals, Object, Vertex};

/// Of what is said of a model.
const MOST_NOTES: usize = 32;

/// Drops triangles, lines and points with a NaN or infinite corner, and objects that are empty then; replaces unusable
/// normals, colours and texture coordinates; and says so.
pub(crate) fn finish(mut loaded: Loaded) -> Loaded {
    let [mut triangles, mut strokes, mut normals, mut colors, mut uvs] = [0; 5];
    for object in &mut loaded.scene.objects {
        if !object.vertices.iter().all(is_bounded) {
            let vertices = &object.vertices;
            let is_drawn = |corners: &[u32]| corners.iter().all(|&v| is_bounded(&vertices[v as usize]));
            triangles += drop(&mut object.triangles, |triangle| is_drawn(triangle));
            strokes += drop(&mut object.lines, |line| is_drawn(line));
            strokes += drop(&mut object.points, |&point| is_drawn(&[point]));
        }
        normals += if object.normals == Normals::Given { replace_missing_normals(object) } else { 0 };
        colors += replace_unbounded_colors(&mut object.vertices);
        uvs += replace_unbounded_uvs(&mut object.uvs);
    }
    loaded.scene.objects.retain(|object| !object.is_empty());
    let mut note = |count: usize, one: &str, many: &str, what: &str| {
        if count > 0 {
            loaded.notes.push(format!("{} {what}", counted(count, one, many)));
        }
    };
    note(triangles, "triangle", "triangles", "dropped: a corner is infinite or not a number");
    note(strokes, "line or point", "lines and points", "dropped: infinite or not a number");
    note(normals, "normal", "normals", "without a direction replaced by the faces'");
    note(colors, "vertex colour", "vertex colours", "replaced by white: infinite or not a number");
    note(uvs, "texture coordinate", "texture coordinates", "replaced by 0: infinite or not a number");
    // A file can be wrong in any number of places, of which nobody reads more than some.
    let more = loaded.notes.len().saturating_sub(MOST_NOTES);
    if more > 0 {
        loaded.notes.truncate(MOST_NOTES);
        loaded.notes.push(format!("and {}", counted(more, "more like these", "more like these")));
    }
    loaded
}

/// How many were dropped.
fn drop<T>(elements: &mut Vec<T>, is_drawn: impl Fn(&T) -> bool) -> usize {
    let before = elements.len();
    elements.retain(is_drawn);
    before - elements.len()
}

fn is_bounded(vertex: &Vertex) -> bool {
    vertex.position.iter().all(|c| c.is_finite())
}

/// Readers mark a normal without a direction by `[0.0; 3]`: it becomes the mean of its faces', weighted by area.
fn replace_missing_normals(object: &mut Object) -> usize {
    const MISSING: [f32; 3] = [0.0; 3];
    if object.vertices.iter().all(|v| v.normal != MISSING) {
        return 0;
    }
    let mut sums = vec![[0.0; 3]; object.vertices.len()];
    let mut used = vec![false; object.vertices.len()];
    for triangle in &object.triangles {
        let [a, b, c] = triangle.map(|v| widen(object.vertices[v as usize].position));
        let area = area_vector_x2(a, b, c);
        for &v in triangle {
            sums[v as usize] = add(sums[v as usize], area);
            used[v as usize] = true;
        }
    }
    let mut replaced = 0;
    for ((vertex, sum), used) in object.vertices.iter_mut().zip(sums).zip(used) {
        if vertex.normal == MISSING {
            vertex.normal = unit_or_zero(sum);
            if vertex.normal == MISSING {
                vertex.normal = [0.0, 0.0, 1.0];
            }
            replaced += usize::from(used);
        }
    }
    replaced
}

fn replace_unbounded_colors(vertices: &mut [Vertex]) -> usize {
    let mut replaced = 0;
    for vertex in vertices {
        if !vertex.color.iter().all(|c| c.is_finite()) {
            vertex.color = Vertex::WHITE;
            replaced += 1;
        }
    }
    replaced
}

fn replace_unbounded_uvs(sets: &mut [Vec<[f32; 2]>]) -> usize {
    let mut replaced = 0;
    for uv in sets.iter_mut().flatten() {
        if !uv.iter().all(|c| c.is_finite()) {
            *uv = [0.0; 2];
            replaced += 1;
        }
    }
    replaced
}
