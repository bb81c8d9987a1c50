//! Drawing whole maps: the faces of cube maps, maps of the ground and of the picture.
//!
//! One shader for all of them. A shader of its own is compiled with the whole pipeline around it, for every SIMD level, and takes seconds; what is computed where is a few lines each.

use super::environment::{Panorama, Prefilter};
use super::ground::{Cast, Darkness};
use super::occlusion::{LookAround, Smooth};
use super::studio::Studio;
use pineda::{
    ColorBuffer, DrawState, Error, Fragment, Indices, Lanes, Mesh, Pass, Renderer, Rgba, Shader, Space, Target, Vec2,
    Vec3, Vec4, shader,
};

/// What is computed at each place.
#[derive(Debug)]
pub(super) enum Paint<'a> {
    /// What the studio looks like in a direction.
    Studio(Studio),
    /// What a panorama shows in a direction.
    Panorama(Panorama),
    /// What a rough surface mirrors.
    Prefilter(Prefilter<'a>),
    /// What hides a pixel's surface from light from all around.
    LookAround(LookAround<'a>),
    /// The same without noise.
    Smooth(Smooth<'a>),
    /// How dark the ground is.
    Darkness(Darkness<'a>),
    /// That darkness, in the picture.
    Cast(Cast<'a>),
}

/// A corner: where it is drawn, and what varies between corners: a direction from a cube's middle, or a place in a map.
pub(super) type Corner = ([f32; 4], [f32; 3]);

#[shader]
impl Shader for Paint<'_> {
    type Vertex = Corner;
    type Varyings<L: Lanes> = Vec3<L>;

    fn vertex(&self, (position, varying): &Corner) -> (Vec4, Vec3) {
        ((*position).into(), (*varying).into())
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let (varying, pixel) = (f.varyings(), Vec2::new(f.x(), f.y()));
        match self {
            Self::Studio(studio) => studio.color(varying),
            Self::Panorama(panorama) => panorama.color(varying),
            Self::Prefilter(prefilter) => prefilter.color(varying),
            Self::LookAround(look_around) => look_around.color(pixel),
            Self::Smooth(smooth) => smooth.color(pixel),
            Self::Darkness(darkness) => darkness.color(pixel),
            Self::Cast(cast) => cast.color(varying.xy()),
        }
    }
}

/// For each face the axes, with their signs, along which s grows, along which t grows, and along which it lies (Vulkan 1.4, 16.5.4).
pub(super) const FACES: [[(usize, f32); 3]; 6] = [
    [(2, -1.0), (1, -1.0), (0, 1.0)],
    [(2, 1.0), (1, -1.0), (0, -1.0)],
    [(0, 1.0), (2, 1.0), (1, 1.0)],
    [(0, 1.0), (2, -1.0), (1, -1.0)],
    [(0, 1.0), (1, -1.0), (2, 1.0)],
    [(0, -1.0), (1, -1.0), (2, -1.0)],
];

/// The direction of a place on a face, both coordinates -1 to 1; not of length 1.
pub(super) fn direction(face: usize, [s, t]: [f32; 2]) -> [f32; 3] {
    let [(along_s, sign_s), (along_t, sign_t), (axis, sign)] = FACES[face];
    let mut direction = [0.0; 3];
    (direction[along_s], direction[along_t], direction[axis]) = (sign_s * s, sign_t * t, sign);
    direction
}

/// All six faces of a level, one below the other as textures have them: `size` x `size` texels each.
pub(super) fn faces(paint: &Paint<'_>, size: u32, renderer: &mut Renderer) -> Result<Vec<[u16; 4]>, Error> {
    let mut corners: Vec<Corner> = Vec::new();
    for face in 0..6 {
        for [s, t] in [[-1.0, -1.0], [-1.0, 1.0], [1.0, 1.0], [-1.0, -1.0], [1.0, 1.0], [1.0, -1.0]] {
            let [x, y] = [0.5 * (s + 1.0), 0.5 * (t + 1.0) + face as f32].map(|x| x * size as f32);
            corners.push(([x, y, 0.0, 1.0], direction(face, [s, t])));
        }
    }
    let mut texels = vec![[0; 4]; 6 * (size * size) as usize];
    draw(
        paint,
        &corners,
        Target { color: ColorBuffer::Rgba16F(&mut texels), ..Target::new(size, 6 * size) },
        renderer,
    )?;
    Ok(texels)
}

/// A whole map.
pub(super) fn map(paint: &Paint<'_>, target: Target<'_>, renderer: &mut Renderer) -> Result<(), Error> {
    let (right, bottom) = (2.0 * target.width as f32, 2.0 * target.height as f32);
    let corners = [[0.0, 0.0], [0.0, bottom], [right, 0.0]].map(|[x, y]| ([x, y, 0.0, 1.0], [0.0; 3]));
    draw(paint, &corners, target, renderer)
}

fn draw(paint: &Paint<'_>, corners: &[Corner], mut target: Target<'_>, renderer: &mut Renderer) -> Result<(), Error> {
    let mut pass = Pass::new();
    let state = DrawState { space: Space::Raster, ..DrawState::default() };
    pass.draw(paint, Mesh { vertices: corners, indices: Indices::Sequential }, state);
    renderer.render(&pass, &mut target)?;
    Ok(())
}
