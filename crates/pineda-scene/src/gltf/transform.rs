//! Nodes' transforms, in f64: a vertex is rounded once, when it has its place in the world.

use super::animation::Animated;
use super::schema::Node;
use crate::vector::{Vec3, cross, dot, each};

/// An affine map: three rows of a 4 x 4 matrix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Affine {
    rows: [[f64; 4]; 3],
}

impl Affine {
    pub(crate) const IDENTITY: Self = Self { rows: [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]] };

    /// Nothing: where sums begin.
    pub(super) const ZERO: Self = Self { rows: [[0.0; 4]; 3] };

    /// A node's own: its matrix, or else translation * rotation * scale; an animation's in place of the node's.
    pub(super) fn of_node(node: &Node, animated: Option<&Animated>) -> Self {
        let moves = |a: &&Animated| a.translation.is_some() || a.rotation.is_some() || a.scale.is_some();
        let animated = animated.filter(moves);
        if let (Some(columns), None) = (&node.matrix, animated) {
            return Self::from_columns(columns);
        }
        let Animated { translation, rotation, scale, .. } = animated.cloned().unwrap_or_default();
        Self::from_parts(
            translation.or(node.translation).unwrap_or([0.0; 3]),
            rotation.or(node.rotation).unwrap_or([0.0, 0.0, 0.0, 1.0]),
            scale.or(node.scale).unwrap_or([1.0; 3]),
        )
    }

    /// From a 4 x 4 matrix, column by column.
    pub(crate) fn from_columns(m: &[f64; 16]) -> Self {
        let row = |r: usize| [m[r], m[4 + r], m[8 + r], m[12 + r]];
        Self { rows: [row(0), row(1), row(2)] }
    }

    /// Translation * rotation * scale; the rotation is a quaternion x, y, z, w.
    pub(super) fn from_parts(translation: Vec3, rotation: [f64; 4], scale: Vec3) -> Self {
        let rotation = rotation_rows(rotation);
        let row = |r: usize| {
            let [x, y, z]: Vec3 = std::array::from_fn(|c| rotation[r][c] * scale[c]);
            [x, y, z, translation[r]]
        };
        Self { rows: [row(0), row(1), row(2)] }
    }

    /// `self + weight * other`, number by number.
    pub(super) fn plus(&self, weight: f64, other: &Self) -> Self {
        let entry = |r: usize, c: usize| self.rows[r][c] + weight * other.rows[r][c];
        Self { rows: std::array::from_fn(|r| std::array::from_fn(|c| entry(r, c))) }
    }

    /// `self` after `first`.
    pub(crate) fn after(&self, first: &Self) -> Self {
        let row = |[x, y, z, t]: [f64; 4]| {
            std::array::from_fn(|c| {
                let sum = x * first.rows[0][c] + y * first.rows[1][c] + z * first.rows[2][c];
                if c == 3 { sum + t } else { sum }
            })
        };
        Self { rows: self.rows.map(row) }
    }

    pub(crate) fn point(&self, p: Vec3) -> Vec3 {
        each(self.rows, |[x, y, z, t]| x * p[0] + y * p[1] + z * p[2] + t)
    }

    /// A direction with its length: not translated.
    pub(super) fn vector(&self, v: Vec3) -> Vec3 {
        each(self.linear(), |row| dot(row, v))
    }

    /// How much longer it makes things, on average over directions: the cube root of what it does to volumes.
    pub(super) fn mean_scale(&self) -> f64 {
        let [a, b, c] = self.linear();
        libm::cbrt(dot(a, cross(b, c)).abs())
    }

    /// Whether it turns left-handed into right-handed, and so front into back.
    pub(crate) fn is_mirrored(&self) -> bool {
        let [a, b, c] = self.linear();
        dot(a, cross(b, c)) < 0.0
    }

    /// What normals are multiplied by: the inverse transpose, up to a positive factor.
    ///
    /// The matrix of cofactors is the determinant times the inverse transpose, and exists for a map that flattens
    /// space, too.
    pub(super) fn normal_map(&self) -> NormalMap {
        let [a, b, c] = self.linear();
        let rows = [cross(b, c), cross(c, a), cross(a, b)];
        let is_mirrored = self.is_mirrored();
        let sign = if is_mirrored { -1.0 } else { 1.0 };
        NormalMap { rows: rows.map(|row| row.map(|x| sign * x)), is_mirrored }
    }

    fn linear(&self) -> [Vec3; 3] {
        each(self.rows, |[x, y, z, _]| [x, y, z])
    }
}

/// A linear map for normals, up to their length.
pub(super) struct NormalMap {
    rows: [Vec3; 3],
    /// Whether the map that it belongs to turns left-handed into right-handed.
    pub(super) is_mirrored: bool,
}

impl NormalMap {
    pub(super) fn apply(&self, normal: Vec3) -> Vec3 {
        each(self.rows, |row| dot(row, normal))
    }
}

/// The rotation by a quaternion x, y, z, w, of any length; none for one without a direction.
fn rotation_rows(quaternion: [f64; 4]) -> [Vec3; 3] {
    let [x, y, z, w] = quaternion;
    let squared = x * x + y * y + z * z + w * w;
    if !(squared > 0.0 && squared.is_finite()) {
        return [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    }
    // Without a square root: so that quarter turns come out exact.
    let s = 2.0 / squared;
    [
        [1.0 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)],
        [s * (x * y + z * w), 1.0 - s * (x * x + z * z), s * (y * z - x * w)],
        [s * (x * z - y * w), s * (y * z + x * w), 1.0 - s * (x * x + y * y)],
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vector::{length, normalize, sub};

    fn node(json: &str) -> Affine {
        Affine::of_node(&serde_json::from_str(json).unwrap(), None)
    }

    #[test]
    fn transform_order_is_scale_rotation_translation() {
        // A quarter turn about z takes x to y.
        let half = 0.5f64.sqrt();
        let trs = node(&format!(r#"{{"translation":[1,2,3],"rotation":[0,0,{half},{half}],"scale":[2,3,4]}}"#));
        assert!(length(sub(trs.point([1.0, 0.0, 0.0]), [1.0, 4.0, 3.0])) < 1e-15);
        assert!(length(sub(trs.point([0.0, 1.0, 1.0]), [-2.0, 2.0, 7.0])) < 1e-15);
        assert!(!trs.is_mirrored());
        // The same as a matrix, by columns.
        let matrix = node(r#"{"matrix":[0,2,0,0, -3,0,0,0, 0,0,4,0, 1,2,3,1]}"#);
        assert!(length(sub(trs.point([5.0, 6.0, 7.0]), matrix.point([5.0, 6.0, 7.0]))) < 1e-14);
    }

    #[test]
    fn transform_identity_changes_no_bit() {
        let p = [0.1, -1e30, 3.0e-39].map(|c: f64| f64::from(c as f32));
        assert_eq!(Affine::IDENTITY.point(p), p);
        assert_eq!(Affine::IDENTITY.after(&node("{}")), Affine::IDENTITY);
    }

    #[test]
    fn transform_parent_after_child() {
        let parent = node(r#"{"scale":[2,2,2]}"#);
        let child = node(r#"{"translation":[1,0,0]}"#);
        assert_eq!(parent.after(&child).point([1.0, 0.0, 0.0]), [4.0, 0.0, 0.0]);
    }

    #[test]
    fn transform_normals_stay_perpendicular_and_outside() {
        for scale in ["[1,2,3]", "[-1,2,3]", "[-1,-2,3]", "[-1,-2,-3]", "[0.001,1000,1]"] {
            let map = node(&format!(r#"{{"rotation":[0.1,0.2,0.3,0.9],"scale":{scale}}}"#));
            let (normal, tangents) = ([1.0, 2.0, 3.0], [[2.0, -1.0, 0.0], [0.0, 3.0, -2.0]]);
            let mapped = normalize(map.normal_map().apply(normal)).unwrap();
            let origin = map.point([0.0; 3]);
            for tangent in tangents {
                let tangent = normalize(sub(map.point(tangent), origin)).unwrap();
                assert!(dot(mapped, tangent).abs() < 1e-12, "{scale}");
            }
            // Outside stays outside, mirrored or not.
            assert!(dot(mapped, sub(map.point(normal), origin)) > 0.0, "{scale}");
        }
    }

    #[test]
    fn transform_that_flattens_keeps_the_plane_s_normal() {
        let flat = node(r#"{"scale":[1,0,1]}"#);
        assert_eq!(normalize(flat.normal_map().apply([0.3, 0.5, 0.2])), Some([0.0, 1.0, 0.0]));
    }

    #[test]
    fn transform_rotation_of_any_length() {
        let p = [1.0, 2.0, 3.0];
        let (a, b) = (node(r#"{"rotation":[0,0,3,3]}"#), node(r#"{"rotation":[0,0,1,1]}"#));
        assert_eq!(a.point(p), b.point(p));
        assert_eq!(node(r#"{"rotation":[0,0,0,0]}"#).point(p), p);
    }
}
