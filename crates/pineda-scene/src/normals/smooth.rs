//! Smooth where the surface is smooth, sharp at its creases.
//!
//! ```text
//! for each corner c of each face f:
//!     normal(c) = sum over corners d at the same place, of faces g with angle(f, g) <= crease,
//!                     of the angle at d times the normal of g
//! ```
//!
//! Weights by angle make the normal independent of how a flat part is cut into triangles (Thürmer and Wüthrich 1998).
//! The condition is taken pair by pair, not along chains of neighbours: so the tip of a cone keeps a normal of its own
//! for each side, and no sequence of small bends adds up to a smooth right angle.
//!
//! Sums run in the order of the triangles, in f64: the same bits everywhere. Corners with the same place, colour,
//! texture coordinates and normal share a vertex.
//!
//! All pairs of k corners are k^2; at places with very many corners, faces are first gathered by direction.

use std::collections::HashMap;

use super::weld::Weld;
use super::{ANY, Rebuilt, corners, face_normal, rounded};
use crate::vector::{Vec3, add, cross, dot, length, normalize, scale, sub};
use crate::{Normals, Object};

/// Gives the object normals averaged over the faces around each place, except across creases: where two faces' normals
/// differ by more than `crease_degrees`, each side keeps its own and the vertices are split.
///
/// 0 makes every bend sharp, 180 none; 30 to 40 suits most models. Vertices at exactly the same place count as one,
/// whether or not the file shares them. Triangles keep their number, corners, colours and texture coordinates; tangents are
/// left out. Lines and points keep the normals that they have.
pub fn smooth_normals(object: &mut Object, crease_degrees: f64) {
    // Tiny allowance: faces that a file's rounding has tilted by less are one plane, also for a crease of 0.
    let cos_crease = libm::cos(crease_degrees.clamp(0.0, 180.0).to_radians()) - 1e-9;
    let weld = Weld::new(&object.vertices);
    let faces: Vec<Option<Vec3>> = object.triangles.iter().map(|&t| face_normal(&object.vertices, t)).collect();
    let around = Around::new(object, &weld);

    let mut normals = vec![[0.0f32; 3]; 3 * object.triangles.len()];
    let mut gathered = Vec::new();
    for place in 0..weld.places {
        let here = around.corners_at(place);
        gathered.clear();
        gathered.extend(here.iter().filter_map(|&corner| {
            let normal = faces[corner as usize / 3]?;
            Some((normal, scale(normal, corner_angle(object, corner))))
        }));
        let everything = sum(gathered.iter().map(|&(_, weighted)| weighted));
        let mut directions = Directions::new(&gathered);
        for &corner in here {
            let normal = match faces[corner as usize / 3] {
                Some(face) => normalize(directions.sum_within(face, cos_crease)).unwrap_or(face),
                // A face without area has no direction of its own to compare.
                None => normalize(everything).unwrap_or(ANY),
            };
            normals[corner as usize] = rounded(normal);
        }
    }
    share_vertices(object, &weld, &normals);
}

fn sum(vectors: impl Iterator<Item = Vec3>) -> Vec3 {
    vectors.fold([0.0; 3], add)
}

/// The angle in radians at a corner (numbered 3 * triangle + 0, 1, 2).
fn corner_angle(object: &Object, corner: u32) -> f64 {
    let triangle = object.triangles[corner as usize / 3];
    let mut points = corners(&object.vertices, triangle);
    points.rotate_left(corner as usize % 3);
    let (u, v) = (sub(points[1], points[0]), sub(points[2], points[0]));
    libm::atan2(length(cross(u, v)), dot(u, v))
}

/// The corners at each place, in the order of the triangles: one list, and where each place's part of it begins.
struct Around {
    starts: Vec<u32>,
    corners: Vec<u32>,
}

impl Around {
    fn new(object: &Object, weld: &Weld) -> Self {
        let place_of = |v: u32| weld.place[v as usize] as usize;
        let mut starts = vec![0u32; weld.places + 1];
        for &v in object.triangles.iter().flatten() {
            starts[place_of(v) + 1] += 1;
        }
        for place in 0..weld.places {
            starts[place + 1] += starts[place];
        }
        let mut next = starts.clone();
        let mut corners = vec![0u32; 3 * object.triangles.len()];
        for (corner, &v) in (0..).zip(object.triangles.iter().flatten()) {
            let slot = &mut next[place_of(v)];
            corners[*slot as usize] = corner;
            *slot += 1;
        }
        Self { starts, corners }
    }

    fn corners_at(&self, place: usize) -> &[u32] {
        &self.corners[self.starts[place] as usize..self.starts[place + 1] as usize]
    }
}

/// The faces around one place, by direction.
enum Directions<'a> {
    /// Unit normals and weighted normals, in order.
    Few(&'a [(Vec3, Vec3)]),
    /// For each occupied cell of directions its members' sum, and the answer for its members once it is known.
    Many { cells: Vec<([i8; 3], Vec3)>, answers: HashMap<[i8; 3], Vec3> },
}

impl<'a> Directions<'a> {
    /// Corners at one place beyond which they are gathered. A fan of 256 sides is still compared pair by pair.
    const FEW: usize = 256;
    /// Cells along each axis from the middle: directions in a cell differ by about 9 degrees at most.
    const CELLS: f64 = 10.0;

    fn new(faces: &'a [(Vec3, Vec3)]) -> Self {
        if faces.len() <= Self::FEW {
            return Self::Few(faces);
        }
        let mut cells: Vec<([i8; 3], Vec3)> = Vec::new();
        let mut index = HashMap::new();
        for &(normal, weighted) in faces {
            let cell = *index.entry(Self::cell(normal)).or_insert_with(|| {
                cells.push((Self::cell(normal), [0.0; 3]));
                cells.len() - 1
            });
            cells[cell].1 = add(cells[cell].1, weighted);
        }
        Self::Many { cells, answers: HashMap::new() }
    }

    fn cell(normal: Vec3) -> [i8; 3] {
        normal.map(|c| libm::floor(c * Self::CELLS) as i8)
    }

    /// The sum of the weighted normals within the crease of `face`, which is one of those given.
    fn sum_within(&mut self, face: Vec3, cos_crease: f64) -> Vec3 {
        let close = |normal: Vec3| dot(face, normal) >= cos_crease;
        match self {
            Self::Few(faces) => sum(faces.iter().filter(|&&(normal, _)| close(normal)).map(|&(_, weighted)| weighted)),
            Self::Many { cells, answers } => *answers.entry(Self::cell(face)).or_insert_with(|| {
                let within =
                    |cell: &&([i8; 3], Vec3)| cell.0 == Self::cell(face) || normalize(cell.1).is_some_and(close);
                sum(cells.iter().filter(within).map(|&(_, weighted)| weighted))
            }),
        }
    }
}

/// Makes one vertex of all corners with the same place, colour, texture coordinates and normal.
fn share_vertices(object: &mut Object, weld: &Weld, normals: &[[f32; 3]]) {
    const NONE: u32 = u32::MAX;
    /// Not sharing a vertex is right, too, so a place with thousands of different normals need not take for ever.
    const LONGEST_SEARCH: u32 = 12;
    let mut rebuilt = Rebuilt::new(object);
    // The vertices made for each place, as a list from the newest on. Lists are short: their number is the number of
    // different normals and colours at one place, and the newest is nearly always the one that is wanted.
    let mut newest = vec![NONE; weld.places];
    let mut older: Vec<u32> = Vec::new();
    let mut triangles = object.triangles.clone();
    for (corner, v) in triangles.iter_mut().flatten().enumerate() {
        let place = weld.place[*v as usize] as usize;
        let mut found = newest[place];
        let mut steps = 0;
        while found != NONE && !rebuilt.is_same(found as usize, object, *v as usize, normals[corner]) {
            steps += 1;
            found = if steps < LONGEST_SEARCH { older[found as usize] } else { NONE };
        }
        if found == NONE {
            found = rebuilt.push(object, *v, normals[corner]);
            older.push(newest[place]);
            newest[place] = found;
        }
        *v = found;
    }
    rebuilt.replace(object, triangles, Normals::Smooth);
}

impl Rebuilt {
    /// Whether the new vertex `at` is the object's vertex `v` with this normal, bit for bit; the place is known to be
    /// the same.
    fn is_same(&self, at: usize, object: &Object, v: usize, normal: [f32; 3]) -> bool {
        let (a, b) = (&self.vertices[at], &object.vertices[v]);
        a.normal.map(f32::to_bits) == normal.map(f32::to_bits)
            && a.color.map(f32::to_bits) == b.color.map(f32::to_bits)
            && self.uvs.iter().zip(&object.uvs).all(|(a, b)| a[at].map(f32::to_bits) == b[v].map(f32::to_bits))
    }
}
