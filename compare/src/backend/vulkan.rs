//! lavapipe and SwiftShader: Vulkan through wgpu, headless. Which of the two answers is decided by the environment of the process.

mod textures;

use super::Backend;
use crate::device::Device;
use crate::scene::{CLEAR_COLOR, HEIGHT, Output, Scene, Shading, WIDTH, gray};
use anyhow::{Context, Result};
use std::borrow::Cow;
use wgpu::util::{BufferInitDescriptor, DeviceExt};

const COLOR_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
const BYTES_PER_ROW: u32 = 4 * WIDTH;
// Rows then need no padding in the buffer, and one copy takes the whole picture out.
const _: () = assert!(BYTES_PER_ROW.is_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT));

pub(super) struct Vulkan {
    version: String,
    device: wgpu::Device,
    queue: wgpu::Queue,
    pipeline: wgpu::RenderPipeline,
    bindings: wgpu::BindGroup,
    vertices: wgpu::Buffer,
    indices: wgpu::Buffer,
    index_count: u32,
    /// None for depth only.
    color: Option<wgpu::Texture>,
    /// What is averaged to `color`, if pixels have several samples.
    samples: Option<wgpu::Texture>,
    depth: wgpu::Texture,
    output: Output,
    readback: wgpu::Buffer,
    pixels: Vec<[u8; 4]>,
}

impl Vulkan {
    pub(super) fn new(scene: &Scene) -> Result<Self> {
        let Device { version, device, queue } = Device::open(wgpu::Features::PRIMITIVE_INDEX)?;
        let uniforms = device.create_buffer_init(&BufferInitDescriptor {
            label: None,
            contents: bytemuck::cast_slice(&uniforms(scene)),
            usage: wgpu::BufferUsages::UNIFORM,
        });
        let pipeline = pipeline(&device, scene);
        let textures = textures::Textures::new(&device, &queue, scene);
        let mut entries = vec![wgpu::BindGroupEntry { binding: 0, resource: uniforms.as_entire_binding() }];
        entries.extend(textures.bindings());
        let bindings = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &pipeline.get_bind_group_layout(0),
            entries: &entries,
        });
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
        let readback = device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: u64::from(BYTES_PER_ROW * HEIGHT),
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Ok(Self {
            version,
            color: color_format(scene.output).map(|format| texture(&device, format, 1, wgpu::TextureUsages::COPY_SRC)),
            samples: (scene.samples > 1)
                .then(|| texture(&device, COLOR_FORMAT, scene.samples, wgpu::TextureUsages::empty())),
            depth: texture(
                &device,
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
            pipeline,
            bindings,
            vertices,
            indices,
            index_count: scene.indices.len() as u32,
            readback,
            pixels: vec![[0; 4]; (WIDTH * HEIGHT) as usize],
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
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.bindings, &[]);
        pass.set_vertex_buffer(0, self.vertices.slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..self.index_count, 0, 0..1);
        drop(pass);
        encoder.copy_texture_to_buffer(
            self.color.as_ref().unwrap_or(&self.depth).as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &self.readback,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(BYTES_PER_ROW),
                    rows_per_image: None,
                },
            },
            picture_size(),
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

/// The uniforms as `vulkan.wgsl` lays them out: a matrix of columns, then three vectors, each with a scalar in its fourth place.
fn uniforms(scene: &Scene) -> [[f32; 4]; 7] {
    let rows = scene.clip_from_world;
    let [x, y, z, w] = std::array::from_fn(|column| rows.map(|row| row[column]));
    let extend = |[x, y, z]: [f32; 3], w| [x, y, z, w];
    match scene.shading {
        Shading::Gouraud | Shading::Translucent | Shading::Floor => [x, y, z, w, [0.0; 4], [0.0; 4], [0.0; 4]],
        Shading::BlinnPhong(lit) | Shading::Textured(lit) | Shading::Shadowed(lit) | Shading::FiveTextures(lit) => {
            [x, y, z, w, extend(lit.eye, lit.ambient), extend(lit.light, lit.specular), extend(lit.albedo, 0.0)]
        }
    }
}

/// What the picture is stored as.
fn color_format(output: Output) -> Option<wgpu::TextureFormat> {
    match output {
        Output::Color => Some(COLOR_FORMAT),
        Output::Depth => None,
        Output::Ids => Some(wgpu::TextureFormat::R32Uint),
    }
}

fn pipeline(device: &wgpu::Device, scene: &Scene) -> wgpu::RenderPipeline {
    let (vertex, mut fragment, cull_mode) = match scene.shading {
        Shading::Gouraud => ("colored_vertex", "colored_fragment", None),
        Shading::Translucent => ("colored_vertex", "translucent_fragment", None),
        Shading::BlinnPhong(_) => ("lit_vertex", "lit_fragment", Some(wgpu::Face::Back)),
        Shading::Textured(_) => ("mapped_vertex", "textured_fragment", Some(wgpu::Face::Back)),
        Shading::Floor => ("mapped_vertex", "floor_fragment", None),
        Shading::Shadowed(_) => ("mapped_vertex", "shadowed_fragment", Some(wgpu::Face::Back)),
        Shading::FiveTextures(_) => ("mapped_vertex", "five_textures_fragment", Some(wgpu::Face::Back)),
    };
    let module = match scene.output {
        Output::Ids => {
            fragment = "id_fragment";
            device.create_shader_module(wgpu::include_wgsl!("vulkan_ids.wgsl"))
        }
        Output::Color | Output::Depth => device.create_shader_module(wgpu::include_wgsl!("vulkan.wgsl")),
    };
    let is_translucent = scene.shading == Shading::Translucent;
    let blend = is_translucent.then_some(wgpu::BlendState::ALPHA_BLENDING);
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
            depth_write_enabled: Some(!is_translucent),
            depth_compare: Some(wgpu::CompareFunction::Less),
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
    format: wgpu::TextureFormat,
    samples: u32,
    usage: wgpu::TextureUsages,
) -> wgpu::Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: picture_size(),
        mip_level_count: 1,
        sample_count: samples,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: usage | wgpu::TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    })
}

fn picture_size() -> wgpu::Extent3d {
    wgpu::Extent3d { width: WIDTH, height: HEIGHT, depth_or_array_layers: 1 }
}
