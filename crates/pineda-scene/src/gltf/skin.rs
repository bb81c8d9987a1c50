//! Skins: vertices that follow several nodes at once (specification, 3.7.3).
//!
//! ```text
//! vertex in the world = (sum of weight * joint's world transform * its inverse bind matrix) * vertex
//! ```
//!
//! The transform of the node that has the mesh does not count.

use super::accessor::{Accessor, Accessors};
use super::schema::{Skin, Whole};
use super::transform::Affine;
use crate::Error;
use crate::limits::Budget;

/// For each joint the map from the mesh's own space to the world.
pub(super) fn joint_matrices(
    skin: &Skin,
    place: &str,
    world: impl Fn(Whole) -> Result<Affine, Error>,
    accessors: &Accessors<'_>,
    budget: &mut Budget,
) -> Result<Vec<Affine>, Error> {
    let bind = skin.inverse_bind_matrices;
    let bind = bind.map(|bind| accessors.get(bind, &format!("{place}, inverse bind matrices"), budget)).transpose()?;
    if let Some(bind) = &bind
        && (bind.channels != 16 || bind.count < skin.joints.len())
    {
        let joints = skin.joints.len();
        return Err(Error::gltf(
            place,
            format!("its {joints} joints need as many inverse bind matrices, of type MAT4"),
        ));
    }
    let matrix = |(number, &joint): (usize, &Whole)| {
        let world = world(joint)?;
        Ok(match &bind {
            Some(bind) => world.after(&Affine::from_columns(&bind.element(number, 0.0))),
            None => world,
        })
    };
    skin.joints.iter().enumerate().map(matrix).collect()
}

/// The joints that a primitive's vertices follow.
pub(super) struct Skinning<'a> {
    /// Of the skin's joints.
    pub(super) matrices: &'a [Affine],
    pub(super) influences: &'a [[Accessor<'a>; 2]],
}

impl Skinning<'_> {
    /// What takes vertex `index` to the world; the error is a joint that the skin does not have.
    pub(super) fn matrix(&self, index: usize) -> Result<Affine, usize> {
        let mut sum = Affine::ZERO;
        let mut total = 0.0;
        for [joints, weights] in self.influences {
            let joints: [f64; 4] = joints.element(index, 0.0);
            let weights: [f64; 4] = weights.element(index, 0.0);
            for (joint, weight) in joints.into_iter().zip(weights) {
                if weight != 0.0 {
                    let joint = joint as usize;
                    sum = sum.plus(weight, self.matrices.get(joint).ok_or(joint)?);
                    total += weight;
                }
            }
        }
        // Weights should add up to 1, but are rounded in most files, and something else in some.
        if total == 1.0 {
            Ok(sum)
        } else if total != 0.0 {
            Ok(Affine::ZERO.plus(1.0 / total, &sum))
        } else {
            self.matrices.first().copied().ok_or(0)
        }
    }
}
