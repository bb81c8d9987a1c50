//! A primitive's attributes, morph targets added: what a vertex has in its mesh's own space.

use super::accessor::{Accessor, Accessors};
use super::draco::DracoMesh;
use super::schema::{Attributes as Named, Primitive, Semantic, Whole};
use crate::Error;
use crate::limits::Budget;

/// The attributes of `count` vertices each.
pub(super) struct Attributes<'a> {
    pub(super) count: usize,
    pub(super) position: Morphed<'a>,
    pub(super) normal: Option<Morphed<'a>>,
    pub(super) tangent: Option<Morphed<'a>>,
    pub(super) color: Option<Morphed<'a>>,
    /// `None` where the primitive leaves a set out.
    pub(super) uvs: Vec<Option<Morphed<'a>>>,
    /// Pairs of joints and weights, four each.
    pub(super) influences: Vec<[Accessor<'a>; 2]>,
}

/// An attribute and what is added to it (specification, 3.7.2.2): `base + sum of weight * target`.
pub(super) struct Morphed<'a> {
    base: Accessor<'a>,
    targets: Vec<(f64, Accessor<'a>)>,
}

impl Morphed<'_> {
    /// Vertex `index`'s; channels that the base does not have are `filler`.
    pub(super) fn element<const N: usize>(&self, index: usize, filler: f64) -> [f64; N] {
        let mut sum = self.base.element(index, filler);
        for (weight, target) in &self.targets {
            let offset: [f64; N] = target.element(index, 0.0);
            for (sum, offset) in sum.iter_mut().zip(offset) {
                *sum += weight * offset;
            }
        }
        sum
    }

    pub(super) fn is_morphed(&self) -> bool {
        !self.targets.is_empty()
    }
}

/// What is asked of a primitive.
pub(super) struct Wanted<'w, 'a> {
    /// The morph targets' weights; missing ones are 0.
    pub(super) weights: &'w [f64],
    /// How many sets of texture coordinates anybody looks at.
    pub(super) uv_sets: u8,
    /// Whether there is a skin.
    pub(super) is_skinned: bool,
    /// Where the attributes are that are compressed.
    pub(super) draco: Option<&'a DracoMesh>,
}

impl<'a> Attributes<'a> {
    /// `place` is for messages; `position` the accessor of POSITION.
    pub(super) fn new(
        accessors: &Accessors<'a>,
        primitive: &Primitive,
        position: Whole,
        wanted: &Wanted<'_, 'a>,
        place: &str,
        budget: &mut Budget,
    ) -> Result<Self, Error> {
        let &Wanted { weights, draco, .. } = wanted;
        let mut reader = Reader { accessors, primitive, weights, draco, place, count: None, budget };
        let position = reader.morphed(Semantic::Position, position, 3..=3)?;
        let mut optional = |semantic, channels| match primitive.attributes.get(semantic) {
            Some(accessor) => reader.morphed(semantic, accessor, channels).map(Some),
            None => Ok(None),
        };
        let normal = optional(Semantic::Normal, 3..=3)?;
        let tangent = optional(Semantic::Tangent, 4..=4)?;
        let color = optional(Semantic::Color(0), 3..=4)?;
        let mut uvs = Vec::new();
        for set in 0..wanted.uv_sets {
            uvs.push(optional(Semantic::TexCoord(set), 2..=2)?);
        }
        while uvs.last().is_some_and(Option::is_none) {
            uvs.pop();
        }
        let mut influences = Vec::new();
        if wanted.is_skinned {
            for set in 0..2 {
                let (joints, weights) = (Semantic::Joints(set), Semantic::Weights(set));
                let get = |semantic| primitive.attributes.get(semantic);
                let (Some(joint), Some(weight)) = (get(joints), get(weights)) else { break };
                influences.push([reader.base(joints, joint, 4..=4)?, reader.base(weights, weight, 4..=4)?]);
            }
        }
        let count = reader.count.unwrap_or_default();
        Ok(Self { count, position, normal, tangent, color, uvs, influences })
    }
}

struct Reader<'r, 'a> {
    accessors: &'r Accessors<'a>,
    primitive: &'r Primitive,
    weights: &'r [f64],
    draco: Option<&'a DracoMesh>,
    place: &'r str,
    /// The first attribute's; all have as many.
    count: Option<usize>,
    budget: &'r mut Budget,
}

impl<'a> Reader<'_, 'a> {
    fn morphed(
        &mut self,
        semantic: Semantic,
        base: Whole,
        channels: std::ops::RangeInclusive<usize>,
    ) -> Result<Morphed<'a>, Error> {
        // A tangent's sign is not morphed.
        let delta_channels = if semantic == Semantic::Tangent { 3..=4 } else { channels.clone() };
        let base = self.base(semantic, base, channels)?;
        let mut targets = Vec::new();
        let primitive = self.primitive;
        for (target, &weight) in primitive.targets.iter().zip(self.weights) {
            // Weight 0 is by far the most frequent.
            if weight != 0.0
                && let Some(accessor) = Named::get(target, semantic)
            {
                self.budget.elements(base.count as u64 / MORPHS_PER_ELEMENT)?;
                targets.push((weight, self.plain(semantic, accessor, delta_channels.clone())?));
            }
        }
        Ok(Morphed { base, targets })
    }

    /// The primitive's own attribute.
    fn base(
        &mut self,
        semantic: Semantic,
        number: Whole,
        channels: std::ops::RangeInclusive<usize>,
    ) -> Result<Accessor<'a>, Error> {
        let Some(bytes) = self.draco.and_then(|draco| draco.attributes.get(&semantic)) else {
            return self.plain(semantic, number, channels);
        };
        let accessor = self.accessors.with_bytes(number, bytes, &format!("{}, {semantic}", self.place))?;
        self.check(semantic, number, channels, accessor)
    }

    fn plain(
        &mut self,
        semantic: Semantic,
        number: Whole,
        channels: std::ops::RangeInclusive<usize>,
    ) -> Result<Accessor<'a>, Error> {
        let accessor = self.accessors.get(number, &format!("{}, {semantic}", self.place), self.budget)?;
        self.check(semantic, number, channels, accessor)
    }

    fn check(
        &mut self,
        semantic: Semantic,
        number: Whole,
        channels: std::ops::RangeInclusive<usize>,
        accessor: Accessor<'a>,
    ) -> Result<Accessor<'a>, Error> {
        let place = self.place;
        if !channels.contains(&accessor.channels) {
            let message = format!("{semantic} with {} numbers each: expected {}", accessor.channels, channels.start());
            return Err(Error::gltf(format!("{place}, accessor {number}"), message));
        }
        let count = *self.count.get_or_insert(accessor.count);
        if accessor.count != count {
            let message = format!("{} elements in {semantic}, but {count} in POSITION", accessor.count);
            return Err(Error::gltf(place, message));
        }
        // Whole numbers as colours and weights are parts of the largest, whether or not the file says so.
        let is_part = matches!(semantic, Semantic::Color(_) | Semantic::Weights(_));
        Ok(if is_part { accessor.normalized() } else { accessor })
    }
}

/// Adding a target costs time only: so much less than an element's memory that the same limit stands for several.
const MORPHS_PER_ELEMENT: u64 = 8;
