//! What a fragment stage may ask of the triangle that it shades: its numbers, and where in it the fragment lies.

use super::{Frag, FragmentKind};
use crate::lanes::Lanes;
use crate::math::{Uint, Vec3};

impl<L: Lanes, V: Copy, K: FragmentKind> Frag<L, V, K> {
    /// The number of the triangle, line or point in its draw, or in its instance of a mesh: what [`Target::triangle_ids`](crate::Target::triangle_ids) would hold. It counts
    /// as submitted, culled and degenerate ones included. Where an edge or a corner of a triangle is drawn, it is the triangle's.
    ///
    /// The shader must say that it asks for ids; it is an error when it is compiled otherwise. A colour for each triangle, from nothing but its number:
    ///
    /// ```
    /// use pineda::*;
    ///
    /// struct Facets;
    ///
    /// #[shader]
    /// impl Shader for Facets {
    ///     type Vertex = [f32; 2];
    ///     type Varyings<L: Lanes> = ();
    ///     const IDS: bool = true;
    ///     fn vertex(&self, &[x, y]: &[f32; 2]) -> (Vec4, ()) {
    ///         (Vec4::from([x, y, 0.0, 1.0]), ())
    ///     }
    ///     fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
    ///         let [r, g, b] = noise::hash3([f.triangle_id(), f.instance_id(), f.draw_id()]);
    ///         Rgba::new(Vec3::new(r.to_unit(), g.to_unit(), b.to_unit()), 1.0)
    ///     }
    /// }
    ///
    /// let corners = [[0.0, 0.0], [0.0, 8.0], [8.0, 0.0], [8.0, 8.0]];
    /// let state = DrawState { topology: PrimitiveTopology::TriangleStrip, space: Space::Raster, ..DrawState::default() };
    /// let mut pass = Pass::new();
    /// pass.draw(&Facets, Mesh { vertices: &corners, indices: Indices::Sequential }, state);
    /// let mut pixels = vec![[0; 4]; 8 * 8];
    /// let mut target = Target { color: ColorBuffer::Rgba8(&mut pixels), ..Target::new(8, 8) };
    /// Renderer::new(Settings::default())?.render(&pass, &mut target)?;
    /// assert_ne!(pixels[0], pixels[63], "two triangles of two colours");
    /// # Ok::<(), Error>(())
    /// ```
    #[inline(always)]
    pub fn triangle_id(&self) -> Uint<L> {
        self.ids()[0]
    }

    /// The number of the [instance](crate::Pass::draw_instanced), as in [`Target::instance_ids`](crate::Target::instance_ids); 0 where a mesh is drawn once. The shader must
    /// ask for it: see [`triangle_id`](Self::triangle_id).
    #[inline(always)]
    pub fn instance_id(&self) -> Uint<L> {
        self.ids()[1]
    }

    /// The number of the draw in its pass, from 0 on, as in [`Target::draw_ids`](crate::Target::draw_ids). The shader must ask for it: see
    /// [`triangle_id`](Self::triangle_id).
    #[inline(always)]
    pub fn draw_id(&self) -> Uint<L> {
        self.ids()[2]
    }

    #[inline(always)]
    fn ids(&self) -> [Uint<L>; 3] {
        const {
            assert!(
                K::IDS,
                "this fragment stage reads f.triangle_id(), f.instance_id() or f.draw_id(): add `const IDS: bool = true;` to its `impl Shader` \
                 (a closure has no ids: implement `Shader` instead)"
            );
        }
        self.parts.ids
    }

    /// Where in its triangle the fragment is shaded: how much each of the three vertices counts, with perspective. `barycentrics().x` is the triangle's first vertex's, and so on, in the
    /// order in which it was submitted; of strips and fans the order of [`PrimitiveTopology`](crate::PrimitiveTopology)'s table.
    ///
    /// They are what [`Target::barycentrics`](crate::Target::barycentrics) holds, bit for bit, where that is of the same place. In lines the first two count for their start and their end, in points the
    /// first; on the edges and corners of a triangle they are the triangle's. They add up to 1, give or take 2^-22, and lie in 0 to 1 wherever the fragment lies in its triangle (the edges of one that is clipped are snapped anew, and may leave it by half a subpixel); with the values f of a varying at the
    /// vertices, `b.x * f[0] + b.y * f[1] + b.z * f[2]` is the varying, up to roundings. To submit the vertices in another order changes the order of the three
    /// numbers, and no bit of them. This is Vulkan's `BaryCoordKHR`.
    ///
    /// Derivatives they have none: give the vertices a varying for that. The shader must say that it asks; it is an error when it is compiled otherwise. A triangle's edges as lines, whatever
    /// its vertices hold:
    ///
    /// ```
    /// use pineda::*;
    ///
    /// struct Edges;
    ///
    /// #[shader]
    /// impl Shader for Edges {
    ///     type Vertex = [f32; 4];
    ///     type Varyings<L: Lanes> = ();
    ///     const BARYCENTRICS: bool = true;
    ///     fn vertex(&self, &position: &[f32; 4]) -> (Vec4, ()) {
    ///         (position.into(), ())
    ///     }
    ///     fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
    ///         let b = f.barycentrics_noperspective();
    ///         let is_edge = b.x.min(b.y).min(b.z).lt(0.05);
    ///         Rgba::opaque(is_edge.select(f.splat([1.0; 3]), f.barycentrics()))
    ///     }
    /// }
    ///
    /// // Its second vertex is four times as far away.
    /// let corners = [[0.0, 0.0, 0.5, 1.0], [64.0, 0.0, 0.5, 4.0], [0.0, 64.0, 0.5, 1.0]];
    /// let state = DrawState { space: Space::Raster, ..DrawState::default() };
    /// let mut pass = Pass::new();
    /// pass.draw(&Edges, Mesh { vertices: &corners, indices: Indices::Sequential }, state);
    /// let mut pixels = vec![[0.0; 4]; 64 * 64];
    /// let mut target = Target { color: ColorBuffer::Rgba32F(&mut pixels), ..Target::new(64, 64) };
    /// Renderer::new(Settings::default())?.render(&pass, &mut target)?;
    /// let [x, y, z, _] = pixels[20 * 64 + 20];
    /// // On the picture it counts for 20.5 / 64, as the third does; in space for a quarter of that.
    /// assert!((x + y + z - 1.0).abs() < 1e-6 && (z - 4.0 * y).abs() < 1e-6 && x > z);
    /// assert_eq!(pixels[1 * 64 + 20], [1.0; 4]);
    /// # Ok::<(), Error>(())
    /// ```
    #[inline(always)]
    pub fn barycentrics(&self) -> Vec3<L> {
        self.both_barycentrics()[0]
    }

    /// The same without perspective, as parts of the triangle's area on the picture: Vulkan's `BaryCoordNoPerspKHR`, what a `#[noperspective]` varying is interpolated with. The shader must ask for it: see
    /// [`barycentrics`](Self::barycentrics).
    #[inline(always)]
    pub fn barycentrics_noperspective(&self) -> Vec3<L> {
        self.both_barycentrics()[1]
    }

    #[inline(always)]
    fn both_barycentrics(&self) -> [Vec3<L>; 2] {
        const {
            assert!(
                K::BARYCENTRICS,
                "this fragment stage reads f.barycentrics() or f.barycentrics_noperspective(): add `const BARYCENTRICS: bool = true;` to its \
                 `impl Shader` (a closure has no barycentric coordinates: implement `Shader` instead)"
            );
        }
        self.parts.barycentrics
    }
}
