use crate::settings::Simd;
use crate::shading::OutputKind;

/// What can be wrong with a pass, a target or the settings.
///
/// Every error is found before anything is drawn: a target that comes back with an error holds what it held before.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A width or height of 0, or beyond [`MAX_SIZE`](crate::MAX_SIZE).
    #[error("a target of {width} x {height} pixels cannot be drawn: both sides must lie in 1 to {}", crate::MAX_SIZE)]
    TargetSize {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
    },
    /// A buffer of the target does not hold one element for each pixel.
    #[error(
        "the target's {buffer} buffer holds {length} elements, but {width} x {height} pixels need {expected}{}",
        if *.samples > 1 { format!(", or {samples} times as many for their samples") } else { String::new() }
    )]
    BufferLength {
        /// The field of [`Target`](crate::Target).
        buffer: &'static str,
        /// Its length.
        length: usize,
        /// Width times height.
        expected: usize,
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// Samples of each pixel.
        samples: usize,
    },
    /// The number of a list's indices (or of vertices, without indices) is not a multiple of three.
    #[error("draw {draw}: {count} {what} do not make whole triangles; give a multiple of three")]
    PartialTriangle {
        /// The draw's number in its pass, from 0.
        draw: usize,
        /// How many there are.
        count: usize,
        /// `indices` or `vertices`.
        what: &'static str,
    },
    /// The number of a list's indices (or of vertices, without indices) is odd.
    #[error("draw {draw}: {count} {what} do not make whole lines; give an even number")]
    PartialLine {
        /// The draw's number in its pass, from 0.
        draw: usize,
        /// How many there are.
        count: usize,
        /// `indices` or `vertices`.
        what: &'static str,
    },
    /// A line width or point size that is NaN or out of range.
    #[error("draw {draw}: a {field} of {value} cannot be drawn: it must lie in {least} to {most}")]
    LineOrPointSize {
        /// The draw's number in its pass, from 0.
        draw: usize,
        /// The field of [`DrawState`](crate::DrawState).
        field: &'static str,
        /// What it holds, in words: NaN is not equal to itself.
        value: String,
        /// The smallest that can be drawn.
        least: u32,
        /// The largest that can be drawn.
        most: u32,
    },
    /// [Conservative](crate::Conservative) lines or points, or edges or corners of triangles.
    #[error(
        "draw {draw}: only filled triangles are rasterized conservatively; switch `conservative` off, or draw triangles with `PolygonMode::Fill`"
    )]
    ConservativeStrokes {
        /// The draw's number in its pass, from 0.
        draw: usize,
    },
    /// [`primitive_restart`](crate::DrawState::primitive_restart) for a list of triangles, lines or points.
    #[error(
        "draw {draw}: a list has nothing to restart; switch `primitive_restart` off, or draw a strip, a fan or a loop"
    )]
    RestartInList {
        /// The draw's number in its pass, from 0.
        draw: usize,
    },
    /// An index names a vertex that is not there.
    #[error("draw {draw}: index {index} at position {position} is out of range: there are {vertices} vertices")]
    IndexOutOfRange {
        /// The draw's number in its pass, from 0.
        draw: usize,
        /// The first index that is out of range.
        index: u32,
        /// Where it stands in the index buffer.
        position: usize,
        /// The number of vertices.
        vertices: usize,
    },
    /// More than 2^32 - 1 vertices, or triangles, lines or points of one instance, or instances, in one draw.
    #[error("draw {draw}: {count} {what} are more than 32-bit numbers can name; split the draw")]
    TooMany {
        /// The draw's number in its pass, from 0.
        draw: usize,
        /// How many there are.
        count: usize,
        /// `vertices`, `triangles`, `lines`, `points` or `instances`; on machines of 32 bits, `vertices of all instances` or `triangles of all instances`, too.
        what: &'static str,
    },
    /// A viewport with a non-finite number, a width that is not positive, a height of 0, or one that is out of range.
    #[error("draw {draw}: the viewport is not usable: {reason}")]
    Viewport {
        /// The draw's number in its pass, from 0.
        draw: usize,
        /// What is wrong with it.
        reason: &'static str,
    },
    /// A depth bias with a number that is NaN or infinite.
    #[error("draw {draw}: the depth bias has a {field} that is not finite")]
    DepthBias {
        /// The draw's number in its pass, from 0.
        draw: usize,
        /// The field of [`DepthBias`](crate::DepthBias).
        field: &'static str,
    },
    /// A target with more colour buffers than [`MAX_COLORS`](crate::MAX_COLORS).
    #[error("a target has at most {} colour buffers, not {colors}", crate::MAX_COLORS)]
    TooManyColors {
        /// How many there are.
        colors: usize,
    },
    /// A fragment stage returns more values than the target has colour buffers, or fewer than the draw writes.
    #[error(
        "draw {draw}: the fragment stage returns {outputs} value(s), but the target has {colors} colour buffer(s); return one for each, or \
         mask what is not to be written"
    )]
    OutputCount {
        /// The draw's number in its pass, from 0.
        draw: usize,
        /// How many values the fragment stage returns.
        outputs: usize,
        /// How many colour buffers the target has.
        colors: usize,
    },
    /// A fragment stage returns another kind of numbers than a colour buffer holds.
    #[error("draw {draw}: the fragment stage returns {returned} for colour buffer {color}, which holds {holds}")]
    OutputKind {
        /// The draw's number in its pass, from 0.
        draw: usize,
        /// The colour buffer: 0 is [`Target::color`](crate::Target::color).
        color: usize,
        /// What the fragment stage returns.
        returned: OutputKind,
        /// What the buffer holds.
        holds: OutputKind,
    },
    /// A draw blends with a colour buffer of integers.
    #[error(
        "draw {draw}: colour buffer {color} holds integers, which are not blended; set `DrawState::colors` for it, with `Blend::OPAQUE`"
    )]
    BlendedIntegers {
        /// The draw's number in its pass, from 0.
        draw: usize,
        /// The colour buffer: 0 is [`Target::color`](crate::Target::color).
        color: usize,
    },
    /// A blend factor takes a second source, which the fragment stage does not return.
    #[error("draw {draw}: a blend factor takes a second source; return a `DualSource` from the fragment stage")]
    NoSecondSource {
        /// The draw's number in its pass, from 0.
        draw: usize,
    },
    /// A blend factor takes a second source, and the target has more than one colour buffer.
    #[error("draw {draw}: a blend factor takes a second source, which goes with one colour buffer, not with {colors}")]
    SecondSourceColors {
        /// The draw's number in its pass, from 0.
        draw: usize,
        /// How many colour buffers the target has.
        colors: usize,
    },
    /// A colour buffer is cleared to another kind of numbers than it holds.
    #[error("colour buffer {color} is cleared to {clear}, but holds {holds}")]
    ClearKind {
        /// The colour buffer: 0 is [`Target::color`](crate::Target::color).
        color: usize,
        /// What it is cleared to.
        clear: OutputKind,
        /// What it holds.
        holds: OutputKind,
    },
    /// A fragment stage asks which sample it shades, and is run once for all samples of a pixel.
    #[error(
        "draw {draw}: the fragment stage reads f.sample_index(), but is run once a pixel; set `sampling: Sampling::Sample`"
    )]
    SampleIndex {
        /// The draw's number in its pass, from 0.
        draw: usize,
    },
    /// The SIMD level was named, and this CPU or build does not have it.
    #[error("this machine has no {asked}; it has {}", list(.available))]
    SimdUnavailable {
        /// The level that was asked for.
        asked: Simd,
        /// The levels that can be asked for here.
        available: Vec<Simd>,
    },
    /// A texture's size, layers or depth are 0 or beyond what there can be.
    #[error(
        "a texture of {width} x {height} texels and {slices} layers or slices cannot be: sides must lie in 1 to {most}, layers and slices in 1 to {most_slices}"
    )]
    TextureSize {
        /// Texels across.
        width: u32,
        /// Texels down.
        height: u32,
        /// Layers, or depth of a 3D texture.
        slices: u32,
        /// The largest side.
        most: u32,
        /// The most layers, or the largest depth.
        most_slices: u32,
    },
    /// A texture with no level, or with more than lead down to a single texel.
    #[error("a texture of {width} x {height} texels has 1 to {most} levels, not {levels}")]
    TextureLevels {
        /// How many levels were given.
        levels: u32,
        /// How many a full chain has.
        most: u32,
        /// Texels across.
        width: u32,
        /// Texels down.
        height: u32,
    },
    /// Another number of texels (or channels) than a texture's size and levels say.
    #[error("a texture of this size and so many levels has {expected} elements, but {length} were given")]
    TextureLength {
        /// How many were given.
        length: usize,
        /// How many there are.
        expected: usize,
    },
    /// A texture with more texels than signed 32-bit numbers can name.
    #[error("a texture of {texels} texels, levels included, is too large: at most {} can be named", i32::MAX)]
    TextureTooLarge {
        /// How many there would be.
        texels: u64,
    },
    /// The system has no memory for what the pass needs.
    #[error("no memory for {bytes} bytes of {what}; draw a smaller target, or lower `Settings::memory`")]
    OutOfMemory {
        /// What was to be allocated.
        bytes: usize,
        /// What for.
        what: &'static str,
    },
}

fn list(levels: &[Simd]) -> String {
    let names: Vec<String> = levels.iter().map(Simd::to_string).collect();
    names.join(", ")
}
