//! lavapipe and SwiftShader: Vulkan through wgpu, headless; and llvmpipe: OpenGL, the same way. Which of the two answers is decided by the environment of the process.

mod textures;

use super::Backend;
use crate::device::Device;
use crate::scene::{CLEAR_COLOR, Draw, Output, Scene, Shading, Size, State, gray};
use anyhow::{Context, Result, ensure};
use std::borrow::Cow;
use std::num::NonZeroU64;
use std::ops::Range;
use wgpu::util::{BufferInitDescriptor, DeviceExt};

const COLOR_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
/// Where uniforms may begin in a buffer: wgpu's default limit, which both drivers keep.
const UNIFORM_ALIGNMENT: usize = 256;

pub(super) struct Vulkan {
    version: String,
    device: wgpu::Device,
    queue: wgpu::Queue,
    pipelines: Vec<(State, wgpu::RenderPipeline)>,
    /// Each draw's indices, the number of its pipeline, and its uniforms and textures.
    draws: Vec<(Range<u32>, usize, wgpu::BindGroup)>,
    vertices: wgpu::Buffer,
    indices: wgpu::Buffer,
    /// None for depth only.
    color: Option<wgpu::Texture>,
    /// What is averaged to `color`, if pixels have several samples.
    samples: Option<wgpu::Texture>,
    depth: wgpu::Texture,
    output: Output,
    readback: wgpu::Buffer,
    size: Size,
    pixels: Vec<[u8; 4]>,
}

impl Vulkan {
    pub(super) fn new(scene: &Scene, backends: wgpu::Backends) -> Result<Self> {
        let Device { version, device, queue } = Device::open(backends, wgpu::Features::PRIMITIVE_INDEX)?;
        let records: Vec<u8> = scene.draws.iter().flat_map(|draw| uniforms(scene, draw)).collect();
        let uniforms = device.create_buffer_init(&BufferInitDescriptor {
            label: None,
            contents: &records,
            usage: wgpu::BufferUsages::UNIFORM,
        });
        let textures = textures::Textures::new(&device, &queue, scene);
        let mut pipelines: Vec<(State, wgpu::RenderPipeline)> = Vec::new();
        let mut draws = Vec::with_capacity(scene.draws.len());
        for (number, draw) in scene.draws.iter().enumerate() {
            let known = pipelines.iter().position(|(state, _)| *state == draw.state);
            let pipeline = known.unwrap_or_else(|| {
                pipelines.push((draw.state, pipeline(&device, scene, draw.state)));
                pipelines.len() - 1
            });
            let record = wgpu::BufferBinding {
                buffer: &uniforms,
                offset: (number * UNIFORM_ALIGNMENT) as u64,
                size: NonZeroU64::new(UNIFORM_ALIGNMENT as u64),
            };
            let mut entries =
                vec![wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::Buffer(record) }];
            entries.extend(textures.bindings());
            let bindings = device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: None,
                layout: &pipelines[pipeline].1.get_bind_group_layout(0),
                entries: &entries,
            });
            draws.push((draw.indices.clone(), pipeline, bindings));
        }
        let records: Vec<[[f32; 3]; 3]> =
            scene.vertices.iter().map(|vertex| [vertex.position, vertex.normal, vertex.color]).collect();
        let vertices = device.create_buffer_init(&BufferInitDescriptor {
            label: None,
            contents: bytemuck::cast_slice(&records),
            usage: wgpu::BufferUsages::VERTEX,
        });
        let indices = device.create_buffer_init(&BufferInitDescriptor {
            label: None,
            contents: bytemuck::cast_slice(&scene.indices),
            usage: wgpu::BufferUsages::INDEX,
        });
        let [width, height] = scene.size;
        // Rows then need no padding in the buffer, and one copy takes the whole picture out.
        ensure!((4 * width).is_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT), "rows of {width} pixels want padding");
        let readback = device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: u64::from(4 * width * height),
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Ok(Self {
            version,
            color: color_format(scene.output)
                .map(|format| texture(&device, scene.size, format, 1, wgpu::TextureUsages::COPY_SRC)),
            samples: (scene.samples > 1)
                .then(|| texture(&device, scene.size, COLOR_FORMAT, scene.samples, wgpu::TextureUsages::empty())),
            depth: texture(
                &device,
                scene.size,
                DEPTH_FORMAT,
                scene.samples,
                if scene.output == Output::Depth {
                    wgpu::TextureUsages::COPY_SRC
                } else {
                    wgpu::TextureUsages::empty()
                },
            ),
            output: scene.output,
            device,
            queue,
            pipelines,
            draws,
            vertices,
            indices,
            readback,
            size: scene.size,
            pixels: vec![[0; 4]; (width * height) as usize],
        })
    }

    fn encode(&self) -> wgpu::CommandBuffer {
        let color_view = self.color.as_ref().map(|color| color.create_view(&wgpu::TextureViewDescriptor::default()));
        let samples_view =
            self.samples.as_ref().map(|samples| samples.create_view(&wgpu::TextureViewDescriptor::default()));
        let depth_view = self.depth.create_view(&wgpu::TextureViewDescriptor::default());
        let [r, g, b, a] = match self.output {
            Output::Ids => [f64::from(u32::MAX); 4],
            Output::Color | Output::Depth => CLEAR_COLOR.map(f64::from),
        };
        let depth_store = if self.color.is_none() { wgpu::StoreOp::Store } else { wgpu::StoreOp::Discard };
        let color_attachment = color_view.as_ref().map(|view| {
            let resolved = samples_view.is_some();
            Some(wgpu::RenderPassColorAttachment {
                view: samples_view.as_ref().unwrap_or(view),
                depth_slice: None,
                resolve_target: resolved.then_some(view),
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a }),
                    store: if resolved { wgpu::StoreOp::Discard } else { wgpu::StoreOp::Store },
                },
            })
        });
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            color_attachments: color_attachment.as_slice(),
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &depth_view,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: depth_store }),
                stencil_ops: None,
            }),
            ..wgpu::RenderPassDescriptor::default()
        });
        pass.set_vertex_buffer(0, self.vertices.slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
        for (indices, pipeline, bindings) in &self.draws {
            pass.set_pipeline(&self.pipelines[*pipeline].1);
            pass.set_bind_group(0, bindings, &[]);
            pass.draw_indexed(indices.clone(), 0, 0..1);
        }
        drop(pass);
        encoder.copy_texture_to_buffer(
            self.color.as_ref().unwrap_or(&self.depth).as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &self.readback,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(4 * self.size[0]),
                    rows_per_image: None,
                },
            },
            picture_size(self.size),
        );
        encoder.finish()
    }
}

impl Backend for Vulkan {
    fn version(&self) -> String {
        self.version.clone()
    }

    fn draw(&mut self) -> Result<()> {
        self.queue.submit([self.encode()]);
        // A failed mapping shows when the range is asked for.
        self.readback.map_async(wgpu::MapMode::Read, .., |_| {});
        self.device.poll(wgpu::PollType::wait_indefinitely()).context("the Vulkan driver lost the frame")?;
        self.pixels.copy_from_slice(bytemuck::cast_slice(&self.readback.get_mapped_range(..)?));
        self.readback.unmap();
        Ok(())
    }

    fn picture(&self) -> Cow<'_, [[u8; 4]]> {
        match self.output {
            Output::Color | Output::Ids => Cow::Borrowed(&self.pixels),
            Output::Depth => self.pixels.iter().map(|&bytes| gray(f32::from_le_bytes(bytes))).collect(),
        }
    }
}

/// A draw's uniforms as `vulkan.wgsl` lays them out: a matrix of columns, then three vectors, each with a scalar in its fourth place; and room up to the next draw's.
fn uniforms(scene: &Scene, draw: &Draw) -> [u8; UNIFORM_ALIGNMENT] {
    let rows = draw.clip_from_world;
    let [x, y, z, w] = std::array::from_fn(|column| rows.map(|row| row[column]));
    let extend = |[x, y, z]: [f32; 3], w| [x, y, z, w];
    let [eye, light, albedo] = match scene.shading {
        Shading::Gouraud | Shading::Floor => [[0.0; 4]; 3],
        Shading::BlinnPhong(lit) | Shading::Textured(lit) | Shading::Shadowed(lit) | Shading::FiveTextures(lit) => {
            [extend(lit.eye, lit.ambient), extend(lit.light, lit.specular), extend(lit.albedo, 0.0)]
        }
    };
    let mut record = [0; UNIFORM_ALIGNMENT];
    let numbers = [x, y, z, w, eye, light, albedo];
    let bytes = bytemuck::cast_slice(&numbers);
    record[..bytes.len()].copy_from_slice(bytes);
    record
}

/// What the picture is stored as.
fn color_format(output: Output) -> Option<wgpu::TextureFormat> {
    match output {
        Output::Color => Some(COLOR_FORMAT),
        Output::Depth => None,
        Output::Ids => Some(wgpu::TextureFormat::R32Uint),
    }
}

fn pipeline(device: &wgpu::Device, scene: &Scene, state: State) -> wgpu::RenderPipeline {
    let (vertex, mut fragment) = match scene.shading {
        Shading::Gouraud if state.blends => ("colored_vertex", "translucent_fragment"),
        Shading::Gouraud => ("colored_vertex", "colored_fragment"),
        Shading::BlinnPhong(_) => ("lit_vertex", "lit_fragment"),
        Shading::Textured(_) => ("mapped_vertex", "textured_fragment"),
        Shading::Floor => ("mapped_vertex", "floor_fragment"),
        Shading::Shadowed(_) => ("mapped_vertex", "shadowed_fragment"),
        Shading::FiveTextures(_) => ("mapped_vertex", "five_textures_fragment"),
    };
    let module = match scene.output {
        Output::Ids => {
            fragment = "id_fragment";
            device.create_shader_module(wgpu::include_wgsl!("vulkan_ids.wgsl"))
        }
        Output::Color | Output::Depth => device.create_shader_module(wgpu::include_wgsl!("vulkan.wgsl")),
    };
    let blend = state.blends.then_some(wgpu::BlendState::ALPHA_BLENDING);
    let cull_mode = state.culls_back_faces.then_some(wgpu::Face::Back);
    let compare = if state.passes_equal { wgpu::CompareFunction::LessEqual } else { wgpu::CompareFunction::Less };
    let target = color_format(scene.output).map(|format| wgpu::ColorTargetState {
        format,
        blend,
        write_mask: wgpu::ColorWrites::ALL,
    });
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: None,
        layout: None,
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some(vertex),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[Some(wgpu::VertexBufferLayout {
                array_stride: 36,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x3],
            })],
        },
        primitive: wgpu::PrimitiveState { cull_mode, ..wgpu::PrimitiveState::default() },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH_FORMAT,
            depth_write_enabled: Some(!state.blends),
            depth_compare: Some(compare),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState { count: scene.samples, ..wgpu::MultisampleState::default() },
        fragment: target.is_some().then_some(wgpu::FragmentState {
            module: &module,
            entry_point: Some(fragment),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[target],
        }),
        multiview_mask: None,
        cache: None,
    })
}

fn texture(
    device: &wgpu::Device,
    size: Size,
    format: wgpu::TextureFormat,
    samples: u32,
    usage: wgpu::TextureUsages,
) -> wgpu::Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: picture_size(size),
        mip_level_count: 1,
        sample_count: samples,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: usage | wgpu::TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    })
}

fn picture_size([width, height]: Size) -> wgpu::Extent3d {
    wgpu::Extent3d { width, height, depth_or_array_layers: 1 }
}
