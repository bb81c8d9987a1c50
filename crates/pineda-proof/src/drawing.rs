//! A case drawn, with everything that a target can hold.

use crate::{Probe, ProbeVertex};
use pineda::{ColorBuffer, DepthBuffer, DrawState, Indices, Mesh, Pass, Renderer, Samples, Space, Statistics, Target};
use pineda_oracle::cases::{self, Case, Random, orders};

/// All outputs of a target, row by row from the top.
#[derive(Clone, Debug)]
pub struct Drawing {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Of each pixel. The buffers hold one after the other.
    pub samples: Samples,
    /// [`Probe`]'s colours: two varyings with perspective, two without.
    pub color: Vec<[f32; 4]>,
    /// As [`Target::depth`].
    pub depth: Vec<f32>,
    /// As [`Target::triangle_ids`].
    pub triangle_ids: Vec<u32>,
    /// As [`Target::instance_ids`].
    pub instance_ids: Vec<u32>,
    /// As [`Target::draw_ids`].
    pub draw_ids: Vec<u32>,
    /// As [`Target::barycentrics`].
    pub barycentrics: Vec<[f32; 3]>,
    /// As [`Target::hits`].
    pub hits: Vec<u32>,
    /// What became of the triangles.
    pub statistics: Statistics,
}

impl Drawing {
    /// Draws a pass to a new target.
    ///
    /// # Errors
    /// What the renderer says.
    pub fn of(renderer: &mut Renderer, pass: &Pass<'_>, width: u32, height: u32) -> Result<Self, pineda::Error> {
        Self::of_samples(renderer, pass, width, height, Samples::One)
    }

    /// Draws a pass to a new target with several samples.
    ///
    /// # Errors
    /// What the renderer says.
    pub fn of_samples(
        renderer: &mut Renderer,
        pass: &Pass<'_>,
        width: u32,
        height: u32,
        samples: Samples,
    ) -> Result<Self, pineda::Error> {
        let pixels = width as usize * height as usize * samples.count();
        let mut drawing = Self {
            width,
            height,
            samples,
            color: vec![[0.0; 4]; pixels],
            depth: vec![0.0; pixels],
            triangle_ids: vec![0; pixels],
            instance_ids: vec![0; pixels],
            draw_ids: vec![0; pixels],
            barycentrics: vec![[0.0; 3]; pixels],
            hits: vec![0; pixels],
            statistics: Statistics::default(),
        };
        drawing.draw_over(renderer, pass)?;
        Ok(drawing)
    }

    /// Draws one more pass to the same buffers.
    ///
    /// # Errors
    /// What the renderer says.
    pub fn draw_over(&mut self, renderer: &mut Renderer, pass: &Pass<'_>) -> Result<(), pineda::Error> {
        let mut target = Target {
            color: ColorBuffer::Rgba32F(&mut self.color),
            depth: DepthBuffer::D32F(&mut self.depth),
            triangle_ids: Some(&mut self.triangle_ids),
            instance_ids: Some(&mut self.instance_ids),
            draw_ids: Some(&mut self.draw_ids),
            barycentrics: Some(&mut self.barycentrics),
            hits: Some(&mut self.hits),
            samples: self.samples,
            ..Target::new(self.width, self.height)
        };
        self.statistics = renderer.render(pass, &mut target)?;
        Ok(())
    }

    /// One sample of each pixel, as a drawing of its own.
    pub fn sample(&self, sample: usize) -> Self {
        fn plane<T: Copy>(buffer: &[T], samples: Samples, sample: usize) -> Vec<T> {
            let pixels = buffer.len() / samples.count();
            buffer[sample * pixels..(sample + 1) * pixels].to_vec()
        }
        Self {
            samples: Samples::One,
            color: plane(&self.color, self.samples, sample),
            depth: plane(&self.depth, self.samples, sample),
            triangle_ids: plane(&self.triangle_ids, self.samples, sample),
            instance_ids: plane(&self.instance_ids, self.samples, sample),
            draw_ids: plane(&self.draw_ids, self.samples, sample),
            barycentrics: plane(&self.barycentrics, self.samples, sample),
            hits: plane(&self.hits, self.samples, sample),
            ..*self
        }
    }

    /// Takes over a pixel from another drawing.
    pub(crate) fn take(&mut self, other: &Self, at: usize) {
        (self.color[at], self.depth[at], self.hits[at]) = (other.color[at], other.depth[at], other.hits[at]);
        (self.triangle_ids[at], self.instance_ids[at]) = (other.triangle_ids[at], other.instance_ids[at]);
        (self.draw_ids[at], self.barycentrics[at]) = (other.draw_ids[at], other.barycentrics[at]);
    }

    /// The first pixel where two drawings are not the same bits, in words.
    pub fn difference(&self, other: &Self) -> Option<String> {
        let bits = |d: &Self, at: usize| {
            let ([r, g, b, a], [u, v, w]) = (d.color[at], d.barycentrics[at]);
            let floats = [d.depth[at], r, g, b, a, u, v, w];
            ([d.triangle_ids[at], d.instance_ids[at], d.draw_ids[at], d.hits[at]], floats.map(f32::to_bits))
        };
        let at = (0..self.color.len()).find(|&at| bits(self, at) != bits(other, at))?;
        let say = |d: &Self| {
            format!(
                "triangle {} of instance {} of draw {}, {} hits, depth {:?}, colour {:?}, barycentrics {:?}",
                d.triangle_ids[at],
                d.instance_ids[at],
                d.draw_ids[at],
                d.hits[at],
                d.depth[at],
                d.color[at],
                d.barycentrics[at]
            )
        };
        let (x, y) = (at % self.width as usize, at / self.width as usize % self.height as usize);
        Some(format!("pixel ({x}, {y}): {} against {}", say(self), say(other)))
    }
}

/// Draws a case with the corners of each triangle in one of the six [`orders`]. The barycentric coordinates come back in the order of the
/// case, whichever the order that was drawn.
pub fn draw_case(renderer: &mut Renderer, case: &Case, order: usize, state: DrawState) -> Result<Drawing, String> {
    draw_case_with_samples(renderer, case, order, state, Samples::One)
}

/// The same with several samples a pixel.
pub fn draw_case_with_samples(
    renderer: &mut Renderer,
    case: &Case,
    order: usize,
    state: DrawState,
    samples: Samples,
) -> Result<Drawing, String> {
    let vertices = vertices(case);
    let indices: Vec<u32> = case.triangles.iter().flat_map(|&triangle| orders(triangle)[order]).collect();
    let state = DrawState { space: space(case), ..state };
    let mut pass = Pass::new();
    pass.draw(&Probe, Mesh { vertices: &vertices, indices: Indices::U32(&indices) }, state);
    let mut drawing =
        Drawing::of_samples(renderer, &pass, case.width, case.height, samples).map_err(|error| error.to_string())?;
    let place = orders([0, 1, 2])[order];
    for weights in &mut drawing.barycentrics {
        let drawn = *weights;
        place.iter().zip(drawn).for_each(|(&corner, weight)| weights[corner as usize] = weight);
    }
    Ok(drawing)
}

/// The vertices of a case with attributes in -1 to 1 that its seed determines.
pub(crate) fn vertices(case: &Case) -> Vec<ProbeVertex> {
    let mut random = Random::new(!case.seed);
    let mut attribute = || random.real(-1.0, 1.0);
    let vertex = |&position: &[f32; 4]| ProbeVertex {
        position,
        smooth: [attribute(), attribute()],
        linear: [attribute(), attribute()],
    };
    case.vertices.iter().map(vertex).collect()
}

/// The space that a case's positions are in.
fn space(case: &Case) -> Space {
    match case.space {
        cases::Space::Raster => Space::Raster,
        cases::Space::Clip => Space::Clip,
    }
}
