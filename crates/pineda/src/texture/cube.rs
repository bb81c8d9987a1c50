//! Cube maps: which face a direction meets, and where; and which texels lie beyond a face's edges.
//!
//! Faces, in order: +x, -x, +y, -y, +z, -z; where a direction meets one is told by Vulkan 1.4's table 18 ("Cube map face and coordinate selection"; the same in
//! D3D11.3). At an edge, filtering goes on with the texels of the face that is adjacent there. At a corner three faces meet, and there is no fourth texel: it is the mean of
//! the other three.

use crate::lanes::Lanes;
use crate::math::{Int, Vec2, Vec3};

/// The face that a direction meets, and the coordinates there, 0 to 1; of the zero vector and of what is not finite, they may be NaN.
#[inline(always)]
pub(super) fn face<L: Lanes>(d: Vec3<L>) -> (Int<L>, Vec2<L>) {
    let (ax, ay, az) = (d.x.abs(), d.y.abs(), d.z.abs());
    let lanes = d.x.lanes();
    let z_major = az.ge(ax) & az.ge(ay);
    let y_major = ay.ge(ax) & !z_major;
    let major = z_major.select(d.z, y_major.select(d.y, d.x));
    let is_negative = major.lt(0.0);
    let axis = z_major.select(Int::new(lanes, 4), y_major.select(Int::new(lanes, 2), 0));
    let face = axis + is_negative.select(Int::new(lanes, 1), 0);
    // Along u: -z, +z; +x; +x, -x. Along v: -y; +z, -z; -y.
    let across = z_major.select(d.x, y_major.select(d.x, -d.z));
    let flips_u = is_negative & !y_major;
    let u = flips_u.select(-across, across);
    let down = y_major.select(d.z, -d.y);
    let v = (is_negative & y_major).select(-down, down);
    let size = major.abs();
    (face, Vec2::new(0.5 * (u / size) + 0.5, 0.5 * (v / size) + 0.5))
}

/// What lies beyond the edges of each face: left, right, top, bottom. There, the other face, and the code of how the texel's place along the edge (counted from the left or the
/// top) becomes (x, y) on it: from the left column down and up, the right one, the top row rightwards and leftwards, the bottom one.
const EDGES: [[(u8, Place); 4]; 6] = {
    use Place::{BottomLeftwards as Bl, BottomRightwards as Br, LeftDown as Ld, LeftUp as Lu};
    use Place::{RightDown as Rd, RightUp as Ru, TopLeftwards as Tl, TopRightwards as Tr};
    [
        [(4, Rd), (5, Ld), (2, Ru), (3, Rd)],
        [(5, Rd), (4, Ld), (2, Ld), (3, Lu)],
        [(1, Tr), (0, Tl), (5, Tl), (4, Tr)],
        [(1, Bl), (0, Br), (4, Br), (5, Bl)],
        [(1, Rd), (0, Ld), (2, Br), (3, Tr)],
        [(0, Rd), (1, Ld), (2, Tl), (3, Bl)],
    ]
};

/// Where along an edge, and in which direction.
#[derive(Clone, Copy)]
enum Place {
    LeftDown,
    LeftUp,
    RightDown,
    RightUp,
    TopRightwards,
    TopLeftwards,
    BottomRightwards,
    BottomLeftwards,
}

/// The face and place of a texel that may lie one beyond the edges of its face. At a corner, where there is none, that of the face nearest to it.
#[inline(always)]
pub(super) fn across_edges(face: i32, x: i32, y: i32, size: i32) -> (i32, i32, i32) {
    let last = size - 1;
    let inside = |k: i32| {
        if k < 0 {
            0
        } else if k > last {
            last
        } else {
            k
        }
    };
    let (edge, along) = if x < 0 {
        (0, inside(y))
    } else if x > last {
        (1, inside(y))
    } else if y < 0 {
        (2, x)
    } else if y > last {
        (3, x)
    } else {
        return (face, x, y);
    };
    let (face, place) = EDGES[face as usize % 6][edge];
    let back = last - along;
    let (x, y) = match place {
        Place::LeftDown => (0, along),
        Place::LeftUp => (0, back),
        Place::RightDown => (last, along),
        Place::RightUp => (last, back),
        Place::TopRightwards => (along, 0),
        Place::TopLeftwards => (back, 0),
        Place::BottomRightwards => (along, last),
        Place::BottomLeftwards => (back, last),
    };
    (face.into(), x, y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::Scalar;

    /// The direction of a texel's centre, from the table's rows the other way round.
    fn direction(face: i32, x: f32, y: f32, size: f32) -> [f32; 3] {
        let (s, t) = (2.0 * (x + 0.5) / size - 1.0, 2.0 * (y + 0.5) / size - 1.0);
        match face {
            0 => [1.0, -t, -s],
            1 => [-1.0, -t, s],
            2 => [s, 1.0, t],
            3 => [s, -1.0, -t],
            4 => [s, -t, 1.0],
            _ => [-s, -t, -1.0],
        }
    }

    #[test]
    fn directions_meet_the_face_and_place_that_they_point_to() {
        for wanted in 0..6 {
            for (x, y) in [(0, 0), (3, 1), (7, 7), (2, 5)] {
                let (found, at) = face::<Scalar>(direction(wanted, x as f32, y as f32, 8.0).into());
                assert_eq!(i32::from(found), wanted);
                assert_eq!([at.x, at.y].map(|s| (f32::from(s) * 8.0) as i32), [x, y]);
            }
        }
    }

    #[test]
    fn texels_across_an_edge_are_neighbours_in_space() {
        let size = 8;
        for from in 0..6 {
            for along in 0..size {
                for (x, y) in [(-1, along), (size, along), (along, -1), (along, size)] {
                    let (to, there_x, there_y) = across_edges(from, x, y, size);
                    assert_ne!(to, from);
                    let inside = |k: i32| k.clamp(0, size - 1) as f32;
                    let here = direction(from, inside(x), inside(y), size as f32);
                    let there = direction(to, there_x as f32, there_y as f32, size as f32);
                    let distance: f32 = here.iter().zip(there).map(|(a, b)| (a - b) * (a - b)).sum();
                    // Each is half a texel from the edge.
                    assert!((distance - 2.0 * (1.0 / 8.0f32).powi(2)).abs() < 1e-5, "{from} ({x}, {y}): {distance}");
                }
            }
        }
    }
}
