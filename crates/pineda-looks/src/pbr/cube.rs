//! Drawing onto the faces of cube maps: what a shader says of each direction.

use pineda::{ColorBuffer, DrawState, Error, Indices, Mesh, Pass, Renderer, Shader, Space, Target};

/// A corner of a face: where it is drawn, and its direction from the cube's middle.
pub(super) type Corner = ([f32; 2], [f32; 3]);

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

/// Draws all six faces of a level, one below the other as textures have them: `size` x `size` texels each.
pub(super) fn draw<S: Shader<Vertex = Corner>>(
    shader: &S,
    size: u32,
    renderer: &mut Renderer,
) -> Result<Vec<[u16; 4]>, Error> {
    let mut corners: Vec<Corner> = Vec::new();
    for face in 0..6 {
        for [s, t] in [[-1.0, -1.0], [-1.0, 1.0], [1.0, 1.0], [-1.0, -1.0], [1.0, 1.0], [1.0, -1.0]] {
            let place = [0.5 * (s + 1.0), 0.5 * (t + 1.0) + face as f32].map(|x| x * size as f32);
            corners.push((place, direction(face, [s, t])));
        }
    }
    let mut pass = Pass::new();
    let state = DrawState { space: Space::Raster, ..DrawState::default() };
    pass.draw(shader, Mesh { vertices: &corners, indices: Indices::Sequential }, state);
    let mut texels = vec![[0; 4]; 6 * (size * size) as usize];
    let mut target = Target { color: ColorBuffer::Rgba16F(&mut texels), ..Target::new(size, 6 * size) };
    renderer.render(&pass, &mut target)?;
    Ok(texels)
}
