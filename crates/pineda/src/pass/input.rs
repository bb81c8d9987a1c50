//! What a vertex stage takes: the vertices of a mesh, or those of each instance of one.

use super::Instanced;
use crate::shading::run::Source;
use std::borrow::Borrow;

/// Vertices, once or for each instance.
pub(crate) trait Input: Sync {
    /// What the vertex stage takes.
    type In;
    /// A vertex stage's input, on its way there.
    type Fetched<'v>: Borrow<Self::In>
    where
        Self: 'v;
    /// Whether there can be more than one instance.
    const IS_INSTANCED: bool;
    fn vertex_count(&self) -> usize;
    fn instance_count(&self) -> usize;
    fn fetch(&self, vertex: usize, instance: usize) -> Self::Fetched<'_>;

    /// The vertex of that [number](Source).
    #[inline(always)]
    fn fetch_number(&self, number: usize) -> Self::Fetched<'_> {
        if !Self::IS_INSTANCED {
            return self.fetch(number, 0);
        }
        self.fetch(number % self.vertex_count(), number / self.vertex_count())
    }
}

/// The vertices of a mesh.
pub(crate) struct Vertices<'a, V>(pub(crate) &'a [V]);

impl<V: Sync> Input for Vertices<'_, V> {
    type In = V;
    type Fetched<'v>
        = &'v V
    where
        Self: 'v;
    const IS_INSTANCED: bool = false;

    fn vertex_count(&self) -> usize {
        self.0.len()
    }

    fn instance_count(&self) -> usize {
        1
    }

    #[inline(always)]
    fn fetch(&self, vertex: usize, _: usize) -> &V {
        &self.0[vertex]
    }
}

/// The vertices of each instance of a mesh.
pub(crate) struct Instances<'a, V, I> {
    pub(crate) vertices: &'a [V],
    pub(crate) instances: &'a [I],
}

impl<V: Copy + Sync, I: Copy + Sync> Input for Instances<'_, V, I> {
    type In = Instanced<V, I>;
    type Fetched<'v>
        = Instanced<V, I>
    where
        Self: 'v;
    const IS_INSTANCED: bool = true;

    fn vertex_count(&self) -> usize {
        self.vertices.len()
    }

    fn instance_count(&self) -> usize {
        self.instances.len()
    }

    #[inline(always)]
    fn fetch(&self, vertex: usize, instance: usize) -> Instanced<V, I> {
        let (vertex_id, instance_id) = (vertex as u32, instance as u32);
        Instanced { vertex: self.vertices[vertex], vertex_id, instance: self.instances[instance], instance_id }
    }
}

/// Goes from place to place through the vertices of a run.
pub(crate) struct Walk<'a> {
    source: Source<'a>,
    place: usize,
    instance: usize,
    /// The next vertex of this instance, or its place in the list.
    next: usize,
    /// Where this instance's end, and the next one's begin again.
    end: usize,
    begin: usize,
}

impl<'a> Walk<'a> {
    /// From `place` on.
    #[inline(always)]
    pub(crate) fn new<I: Input>(input: &I, source: Source<'a>, place: usize) -> Self {
        let mut this = Self { source, place, instance: 0, next: 0, end: usize::MAX, begin: 0 };
        if I::IS_INSTANCED {
            // The only divisions: an instance may be one triangle.
            let number = source.vertex(place);
            this.instance = number / input.vertex_count();
            this.next = number % input.vertex_count();
            match source {
                Source::Range(_) => {}
                Source::List { indices, .. } => (this.next, this.end) = (place % indices.len(), indices.len()),
                Source::Instances { each, .. } => {
                    this.begin = this.next - place % each;
                    this.end = this.begin + each;
                }
            }
        }
        this
    }

    /// The vertex stage's next input.
    #[inline(always)]
    pub(crate) fn next<'v, I: Input>(&mut self, input: &'v I) -> I::Fetched<'v> {
        let place = self.place;
        self.place += 1;
        if !I::IS_INSTANCED {
            return input.fetch(self.source.vertex_of_one(place), 0);
        }
        if self.next == self.end {
            self.instance += 1;
            self.next = self.begin;
        }
        let next = self.next;
        self.next += 1;
        let vertex = if let Source::List { indices, .. } = self.source { indices[next] as usize } else { next };
        input.fetch(vertex, self.instance)
    }
}
