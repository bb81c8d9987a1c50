//! Which vertices are at the same place.

use std::collections::HashMap;

use crate::Vertex;

/// Vertices grouped by position, compared exactly; -0 is 0.
pub(super) struct Weld {
    /// For each vertex the number of its place.
    pub(super) place: Vec<u32>,
    /// How many places there are.
    pub(super) places: usize,
}

impl Weld {
    /// Places are numbered in the order of their first vertices, so nothing depends on the hash.
    pub(super) fn new(vertices: &[Vertex]) -> Self {
        let mut numbers: HashMap<[u32; 3], u32> = HashMap::with_capacity(vertices.len());
        let mut number = |vertex: &Vertex| {
            let next = numbers.len() as u32;
            *numbers.entry(vertex.position.map(|c| (c + 0.0).to_bits())).or_insert(next)
        };
        let place = vertices.iter().map(&mut number).collect();
        Self { place, places: numbers.len() }
    }
}
