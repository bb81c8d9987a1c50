//! A draw with its shader erased: what a pass holds. Inside, everything is compiled for the shader, and its fragment stage for SIMD levels.

use super::input::{Input, Walk};
use super::{DrawState, Indices};
use crate::geometry::project::Projection;
use crate::geometry::raster_space::ScreenVertex;
use crate::lanes::Scalar;
use crate::math::Vec4;
use crate::shading::packet::{PacketBatch, VaryingLayout};
use crate::shading::run::{RECORD_HEADER, RecordRow, Source, record_rows};
use crate::shading::{
    __Layout as Layout, Closure, ClosureFragment, ClosureKind, FragmentKind, Interpolation, MAX_CLIP_DISTANCES, Native,
    OutputLayout, Outputs, Shader, StageUses, Varyings, native,
};
use crate::wide::dispatch_shader;
use bytemuck::must_cast_slice_mut;
use fearless_simd::Level;
use std::borrow::Borrow;

/// A mesh, a shader and a state.
pub(crate) trait DrawCall: Sync {
    fn state(&self) -> &DrawState;
    fn indices(&self) -> Indices<'_>;
    /// Of one instance.
    fn vertex_count(&self) -> usize;
    fn instance_count(&self) -> usize;
    fn layout(&self) -> VaryingLayout;
    fn uses(&self) -> StageUses;
    fn outputs(&self) -> OutputLayout;
    /// The position of the vertex of that [number](Source).
    fn position(&self, vertex: usize) -> [f32; 4];
    /// Its clip distances; 0 beyond the last.
    fn clip_distances(&self, vertex: usize) -> [f32; MAX_CLIP_DISTANCES];
    /// The size of that vertex's point, if it has one of its own.
    fn point_size(&self, _vertex: usize) -> Option<f32> {
        None
    }
    /// Runs the vertex stage for the vertices at places `first_place` on, as many as there are screen vertices.
    fn run_vertices(&self, level: Level, job: VertexJob<'_>);
    /// Runs the fragment stage.
    fn run_fragments(&self, level: Level, batch: &mut PacketBatch);

    /// Rows of four words of a vertex record.
    fn record_rows(&self) -> usize {
        record_rows(self.layout().interpolation.len())
    }
}

/// Vertices to be shaded, and where to put them.
pub(crate) struct VertexJob<'a> {
    pub(crate) source: Source<'a>,
    pub(crate) first_place: usize,
    pub(crate) projection: &'a Projection,
    pub(crate) screen: &'a mut [ScreenVertex],
    pub(crate) records: &'a mut [RecordRow],
}

/// A draw with a [`Shader`].
pub(crate) struct ShaderDraw<'a, Sh, G> {
    pub(crate) shader: &'a Sh,
    pub(crate) input: G,
    pub(crate) indices: Indices<'a>,
    pub(crate) state: DrawState,
}

/// What is interpolated for a shader.
trait WithPointCoord {
    const LAYOUT: Layout;
    const INTERPOLATION: &'static [Interpolation];
}

impl<Sh: Shader> WithPointCoord for Sh {
    const LAYOUT: Layout = {
        let own = Layout::EMPTY.with(<Sh::Varyings<Scalar> as Varyings<Scalar>>::INTERPOLATION, None);
        // All over a point's square w is the same: with perspective or without is the same, too.
        if Sh::POINT_COORD { own.with(&[Interpolation::Perspective; 2], None) } else { own }
    };
    const INTERPOLATION: &'static [Interpolation] = Self::LAYOUT.interpolation();
}

/// A vertex stage as a function.
trait VertexStage<In, V> {
    /// How many clip distances it gives.
    const CLIP_DISTANCES: usize;
    /// Whether the record ends with a point's coordinates.
    const POINT_COORD: bool;
    fn run(&self, vertex: &In) -> (Vec4, V);
    fn clip_distances(&self, vertex: &In) -> [f32; MAX_CLIP_DISTANCES];
}

impl<Sh: Shader> VertexStage<Sh::Vertex, Sh::Varyings<Scalar>> for Sh {
    const CLIP_DISTANCES: usize = {
        assert!(Sh::CLIP_DISTANCES <= MAX_CLIP_DISTANCES, "a vertex has at most eight clip distances");
        Sh::CLIP_DISTANCES
    };

    const POINT_COORD: bool = Sh::POINT_COORD;
    #[inline(always)]
    fn run(&self, vertex: &Sh::Vertex) -> (Vec4, Sh::Varyings<Scalar>) {
        self.vertex(vertex)
    }

    #[inline(always)]
    fn clip_distances(&self, vertex: &Sh::Vertex) -> [f32; MAX_CLIP_DISTANCES] {
        Shader::clip_distances(self, vertex)
    }
}

impl<Sh: Shader, G: Input<In = Sh::Vertex>> DrawCall for ShaderDraw<'_, Sh, G> {
    fn state(&self) -> &DrawState {
        &self.state
    }

    fn indices(&self) -> Indices<'_> {
        self.indices
    }

    fn vertex_count(&self) -> usize {
        self.input.vertex_count()
    }

    fn instance_count(&self) -> usize {
        self.input.instance_count()
    }

    fn layout(&self) -> VaryingLayout {
        let interpolation = <Sh as WithPointCoord>::INTERPOLATION;
        let layout = VaryingLayout::new(interpolation, <Sh as FragmentKind>::DERIVATIVES);
        let is_plain = layout.is_plain && !Sh::BARYCENTRICS;
        VaryingLayout { point_coord: Sh::POINT_COORD, barycentrics: Sh::BARYCENTRICS, is_plain, ..layout }
    }

    fn uses(&self) -> StageUses {
        StageUses::of::<Sh>()
    }

    fn outputs(&self) -> OutputLayout {
        OutputLayout::of::<Scalar, Sh::Output<Scalar>>()
    }

    fn position(&self, vertex: usize) -> [f32; 4] {
        array(self.shader.vertex(self.input.fetch_number(vertex).borrow()).0)
    }

    fn clip_distances(&self, vertex: usize) -> [f32; MAX_CLIP_DISTANCES] {
        let mut distances = self.shader.clip_distances(self.input.fetch_number(vertex).borrow());
        distances[Sh::CLIP_DISTANCES..].fill(0.0);
        distances
    }

    fn point_size(&self, vertex: usize) -> Option<f32> {
        self.shader.point_size(self.input.fetch_number(vertex).borrow())
    }

    fn run_vertices(&self, level: Level, job: VertexJob<'_>) {
        run_vertices(level, self.shader, &self.input, job);
    }

    fn run_fragments(&self, level: Level, batch: &mut PacketBatch) {
        self.shader.run_at(level, batch);
    }
}

/// A fragment stage at the levels that it is compiled for.
///
/// A trait of the shader itself, because the compiler puts a method where the type that it is of was declared: shaders of several modules are compiled at the same time.
trait AtLevels {
    fn run_at(&self, level: Level, batch: &mut PacketBatch);
}

impl<Sh: Shader> AtLevels for Sh {
    #[inline(never)]
    fn run_at(&self, level: Level, batch: &mut PacketBatch) {
        dispatch_shader!(level, s => batch.run(s, self));
    }
}

/// A draw with closures.
pub(crate) struct ClosureDraw<'a, G, T: Varyings<Scalar>, V, F, O> {
    pub(crate) vertex: V,
    pub(crate) fragment: Closure<F, T::At<Native>, O>,
    pub(crate) input: G,
    pub(crate) indices: Indices<'a>,
    pub(crate) state: DrawState,
}

/// A vertex closure as a stage.
struct VertexClosure<'a, V>(&'a V);

impl<In, T, V: Fn(&In) -> (Vec4, T)> VertexStage<In, T> for VertexClosure<'_, V> {
    const CLIP_DISTANCES: usize = 0;
    const POINT_COORD: bool = false;
    #[inline(always)]
    fn run(&self, vertex: &In) -> (Vec4, T) {
        (self.0)(vertex)
    }

    #[inline(always)]
    fn clip_distances(&self, _: &In) -> [f32; MAX_CLIP_DISTANCES] {
        [0.0; MAX_CLIP_DISTANCES]
    }
}

impl<G, T, V, F, O> DrawCall for ClosureDraw<'_, G, T, V, F, O>
where
    G: Input,
    T: Varyings<Scalar>,
    V: Fn(&G::In) -> (Vec4, T) + Sync,
    F: Fn(&mut ClosureFragment<T::At<Native>>) -> O + Sync,
    O: Outputs<Native>,
{
    fn state(&self) -> &DrawState {
        &self.state
    }

    fn indices(&self) -> Indices<'_> {
        self.indices
    }

    fn vertex_count(&self) -> usize {
        self.input.vertex_count()
    }

    fn instance_count(&self) -> usize {
        self.input.instance_count()
    }

    fn layout(&self) -> VaryingLayout {
        VaryingLayout::new(T::INTERPOLATION, false)
    }

    fn uses(&self) -> StageUses {
        StageUses::of::<ClosureKind>()
    }

    fn outputs(&self) -> OutputLayout {
        OutputLayout::of::<Native, O>()
    }

    fn position(&self, vertex: usize) -> [f32; 4] {
        array((self.vertex)(self.input.fetch_number(vertex).borrow()).0)
    }

    fn clip_distances(&self, _: usize) -> [f32; MAX_CLIP_DISTANCES] {
        [0.0; MAX_CLIP_DISTANCES]
    }

    fn run_vertices(&self, level: Level, job: VertexJob<'_>) {
        run_vertices::<G, T, _>(level, &VertexClosure(&self.vertex), &self.input, job);
    }

    fn run_fragments(&self, _: Level, batch: &mut PacketBatch) {
        batch.run(native().0, &self.fragment);
    }
}

#[inline(always)]
fn array(v: Vec4) -> [f32; 4] {
    [v.x.0, v.y.0, v.z.0, v.w.0]
}

/// Sixteen vertices at a time: the user's stage one by one, the projection in the lanes.
fn run_vertices<G: Input, V: Varyings<Scalar>, St: VertexStage<G::In, V>>(
    level: Level,
    stage: &St,
    input: &G,
    job: VertexJob<'_>,
) {
    let rows = record_rows(V::LEN + if St::POINT_COORD { 2 } else { 0 });
    let VertexJob { source, first_place, projection, screen, records } = job;
    if screen.is_empty() {
        return;
    }
    let mut walk = Walk::new(input, source, first_place);
    let mut at = 0;
    while at < screen.len() {
        let count = (screen.len() - at).min(16);
        let mut positions = [[0.0, 0.0, 0.0, 1.0]; 16];
        let mut distances = [[0.0; MAX_CLIP_DISTANCES]; 16];
        let mut k = 0;
        while k < count {
            let vertex = walk.next(input);
            let (position, varyings) = stage.run(vertex.borrow());
            positions[k] = array(position);
            if St::CLIP_DISTANCES > 0 {
                distances[k] = stage.clip_distances(vertex.borrow());
            }
            let record: &mut [u32] = must_cast_slice_mut(&mut records[(at + k) * rows..(at + k + 1) * rows]);
            varyings.write(must_cast_slice_mut(&mut record[RECORD_HEADER..]));
            if St::POINT_COORD {
                record[RECORD_HEADER + V::LEN..RECORD_HEADER + V::LEN + 2].fill(0);
            }
            k += 1;
        }
        let mut projected = [ScreenVertex::default(); 16];
        projection.project(level, &positions, &mut projected);
        let mut k = 0;
        while k < count {
            if St::CLIP_DISTANCES > 0 {
                projection.clip(positions[k], &distances[k][..St::CLIP_DISTANCES], &mut projected[k]);
            }
            let vertex = projected[k];
            screen[at + k] = vertex;
            let record = &mut records[(at + k) * rows];
            record[0] = vertex.0[0];
            record[1] = vertex.0[1];
            record[2] = vertex.0[3];
            k += 1;
        }
        at += 16;
    }
}
