//! A sheet drawn with a Vulkan driver, through wgpu: one render pass, and everything read back.

use super::sheet::{Colors, DepthFormat, Draw, Picture, Sampled, Sheet, Vertex};
use super::states::{color_format, depth_format, pipeline};
use crate::device::Device;
use anyhow::{Context, Result};
use std::collections::HashMap;
use wgpu::util::{BufferInitDescriptor, DeviceExt};

pub(crate) mod lookups;

/// What a run wants of WebGPU's optional features.
const WANTED: wgpu::Features = wgpu::Features::DEPTH_CLIP_CONTROL
    .union(wgpu::Features::FLOAT32_BLENDABLE)
    .union(wgpu::Features::FLOAT32_FILTERABLE)
    .union(wgpu::Features::ADDRESS_MODE_CLAMP_TO_BORDER);

/// The driver's device, and the pipelines that it has built.
pub(crate) struct Theirs {
    device: Device,
    module: wgpu::ShaderModule,
    lookups: wgpu::ShaderModule,
    readers: Readers,
    pipelines: HashMap<String, wgpu::RenderPipeline>,
}

/// What writes a texture's values to a buffer: not every format of depth can be copied, and no texture of several samples.
struct Readers {
    depth: wgpu::ComputePipeline,
    sampled_depth: wgpu::ComputePipeline,
    sampled_color: wgpu::ComputePipeline,
}

/// What is drawn to.
struct Attachments {
    color: wgpu::Texture,
    depth: Option<wgpu::Texture>,
    averages: Option<wgpu::Texture>,
}

impl Theirs {
    pub(crate) fn new() -> Result<Self> {
        let device = Device::open(wgpu::Backends::VULKAN, WANTED)?;
        let module = device.device.create_shader_module(wgpu::include_wgsl!("theirs.wgsl"));
        let reader = |name| {
            device.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: None,
                layout: None,
                module: &module,
                entry_point: Some(name),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                cache: None,
            })
        };
        let readers = Readers {
            depth: reader("read_depth"),
            sampled_depth: reader("read_sampled_depth"),
            sampled_color: reader("read_sampled_color"),
        };
        let lookups = device.device.create_shader_module(wgpu::include_wgsl!("theirs/lookups.wgsl"));
        Ok(Self { device, module, lookups, readers, pipelines: HashMap::new() })
    }

    /// Name and version.
    pub(crate) fn version(&self) -> &str {
        &self.device.version
    }

    /// Whether triangles can be drawn with their depths clamped instead of being clipped.
    pub(crate) fn has_depth_clamp(&self) -> bool {
        self.device.device.features().contains(wgpu::Features::DEPTH_CLIP_CONTROL)
    }

    /// Whether targets of f32 can be blended to.
    pub(crate) fn blends_floats(&self) -> bool {
        self.device.device.features().contains(wgpu::Features::FLOAT32_BLENDABLE)
    }

    /// Draws a sheet.
    pub(crate) fn draw(&mut self, sheet: &Sheet) -> Result<Picture> {
        let pipelines: Vec<_> = sheet.draws.iter().map(|draw| self.pipeline(draw, sheet)).collect();
        let buffers = self.upload_meshes(sheet);
        let (color, samples) = (color_format(&sheet.colors), sheet.samples.count());
        let attachments = Attachments {
            color: self.texture(sheet, color, samples),
            depth: depth_format(sheet.depth).map(|format| self.texture(sheet, format, samples)),
            averages: (sheet.samples == Sampled::Averaged).then(|| self.texture(sheet, color, 1)),
        };
        self.upload_pixels(sheet, &attachments);

        let mut encoder = self.device.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encode_draws(&mut encoder, sheet, &pipelines, &buffers, &attachments);
        let Attachments { color, depth, averages } = &attachments;
        let pixels = sheet.pixels() as u64;
        let color_size = match sheet.colors {
            Colors::Unorm8(_) | Colors::Srgb8(_) => 4,
            Colors::Float16(_) => 8,
            Colors::Float32(_) => 16,
        };
        let read_color = if sheet.samples == Sampled::FourTimes {
            self.encode_reader(&mut encoder, sheet, color, &self.readers.sampled_color)
        } else {
            let buffer = self.readback(pixels * color_size);
            copy(&mut encoder, sheet, averages.as_ref().unwrap_or(color), wgpu::TextureAspect::All, &buffer);
            buffer
        };
        let depth_reader = match sheet.samples {
            Sampled::Once => &self.readers.depth,
            Sampled::FourTimes | Sampled::Averaged => &self.readers.sampled_depth,
        };
        let read_depth = depth.as_ref().map(|depth| self.encode_reader(&mut encoder, sheet, depth, depth_reader));
        let read_stencil = depth.as_ref().filter(|_| !sheet.stencil.is_empty()).map(|depth| {
            let buffer = self.readback(pixels);
            copy(&mut encoder, sheet, depth, wgpu::TextureAspect::StencilOnly, &buffer);
            buffer
        });
        self.device.queue.submit([encoder.finish()]);

        let bytes = self.read(&read_color)?;
        let colors = match &sheet.colors {
            Colors::Unorm8(_) => Colors::Unorm8(bytemuck::pod_collect_to_vec(&bytes)),
            Colors::Srgb8(_) => Colors::Srgb8(bytemuck::pod_collect_to_vec(&bytes)),
            Colors::Float16(_) => Colors::Float16(bytemuck::pod_collect_to_vec(&bytes)),
            Colors::Float32(_) => Colors::Float32(bytemuck::pod_collect_to_vec(&bytes)),
        };
        let depth = match &read_depth {
            None => Vec::new(),
            Some(buffer) => bytemuck::pod_collect_to_vec(&self.read(buffer)?),
        };
        let stencil = read_stencil.as_ref().map_or(Ok(Vec::new()), |buffer| self.read(buffer))?;
        Ok(Picture { colors, depth: stored(sheet.depth, depth), stencil })
    }

    /// The pipeline for a draw: what is not part of one is set while drawing.
    fn pipeline(&mut self, draw: &Draw, sheet: &Sheet) -> wgpu::RenderPipeline {
        let mut state = draw.state;
        (state.viewport, state.scissor, state.blend.constant) = (None, None, [0.0; 4]);
        if let Some(stencil) = &mut state.stencil {
            (stencil.front.reference, stencil.back.reference) = (0, 0);
        }
        let formats =
            (color_format(&sheet.colors), sheet.depth, sheet.samples, draw.interpolation, draw.indices.is_some());
        let Self { device, module, pipelines, .. } = self;
        let build = || pipeline(&device.device, module, draw, sheet);
        pipelines.entry(format!("{state:?} {formats:?}")).or_insert_with(build).clone()
    }

    /// All draws' vertices, and all their indices.
    fn upload_meshes(&self, sheet: &Sheet) -> [wgpu::Buffer; 2] {
        let mut vertices: Vec<Vertex> = Vec::new();
        let mut indices: Vec<u32> = Vec::new();
        for draw in &sheet.draws {
            // WebGPU has no viewports upside down: the shader's y says it there.
            let is_flipped = draw.state.viewport.is_some_and(|viewport| viewport.height < 0.0);
            let flipped = |&Vertex { position: [x, y, z, w], color }: &Vertex| Vertex {
                position: [x, if is_flipped { -y } else { y }, z, w],
                color,
            };
            vertices.extend(draw.vertices.iter().map(flipped));
            indices.extend(draw.indices.iter().flatten());
        }
        // An empty buffer cannot be bound.
        indices.push(0);
        let buffer = |contents: &[u8], usage| {
            self.device.device.create_buffer_init(&BufferInitDescriptor { label: None, contents, usage })
        };
        [
            buffer(bytemuck::cast_slice(&vertices), wgpu::BufferUsages::VERTEX),
            buffer(bytemuck::cast_slice(&indices), wgpu::BufferUsages::INDEX),
        ]
    }

    fn texture(&self, sheet: &Sheet, format: wgpu::TextureFormat, sample_count: u32) -> wgpu::Texture {
        self.device.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: size(sheet),
            mip_level_count: 1,
            sample_count,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT
                | wgpu::TextureUsages::COPY_SRC
                | wgpu::TextureUsages::COPY_DST
                | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        })
    }

    fn upload_pixels(&self, sheet: &Sheet, Attachments { color, depth, .. }: &Attachments) {
        // Several samples cannot be uploaded; they begin as zeros, as all textures do.
        if sheet.samples != Sampled::Once {
            return;
        }
        let write = |texture: &wgpu::Texture, aspect, data: &[u8]| {
            let bytes_per_row = Some((data.len() / sheet.side as usize) as u32);
            let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row, rows_per_image: None };
            let texture = wgpu::TexelCopyTextureInfo { aspect, ..texture.as_image_copy() };
            self.device.queue.write_texture(texture, data, layout, size(sheet));
        };
        let data = match &sheet.colors {
            Colors::Unorm8(codes) | Colors::Srgb8(codes) => codes.as_flattened(),
            Colors::Float16(colors) => bytemuck::cast_slice(colors),
            Colors::Float32(colors) => bytemuck::cast_slice(colors),
        };
        write(color, wgpu::TextureAspect::All, data);
        if let Some(depth) = depth.as_ref().filter(|_| !sheet.stencil.is_empty()) {
            write(depth, wgpu::TextureAspect::StencilOnly, &sheet.stencil);
        }
    }

    fn readback(&self, size: u64) -> wgpu::Buffer {
        let usage = wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST;
        self.buffer(size, usage)
    }

    fn buffer(&self, size: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
        self.device.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size,
            usage,
            mapped_at_creation: false,
        })
    }

    /// Has every value of a texture written to a buffer, 32 bits each.
    fn encode_reader(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        sheet: &Sheet,
        texture: &wgpu::Texture,
        reader: &wgpu::ComputePipeline,
    ) -> wgpu::Buffer {
        let bytes = 4 * sheet.pixels() as u64 * u64::from(texture.sample_count());
        let storage = self.buffer(bytes, wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC);
        let is_depth = texture.format().has_depth_aspect();
        let view = texture.create_view(&wgpu::TextureViewDescriptor {
            aspect: if is_depth { wgpu::TextureAspect::DepthOnly } else { wgpu::TextureAspect::All },
            ..wgpu::TextureViewDescriptor::default()
        });
        let bindings = self.device.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &reader.get_bind_group_layout(0),
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(&view) },
                wgpu::BindGroupEntry { binding: 1, resource: storage.as_entire_binding() },
            ],
        });
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(reader);
        pass.set_bind_group(0, &bindings, &[]);
        pass.dispatch_workgroups(sheet.side / 64, sheet.side, texture.sample_count());
        drop(pass);
        let readback = self.readback(bytes);
        encoder.copy_buffer_to_buffer(&storage, 0, &readback, 0, bytes);
        readback
    }

    fn read(&self, buffer: &wgpu::Buffer) -> Result<Vec<u8>> {
        // A failed mapping shows when the range is asked for.
        buffer.map_async(wgpu::MapMode::Read, .., |_| {});
        self.device.device.poll(wgpu::PollType::wait_indefinitely()).context("the Vulkan driver lost the picture")?;
        let bytes = buffer.get_mapped_range(..)?.to_vec();
        Ok(bytes)
    }
}

fn encode_draws(
    encoder: &mut wgpu::CommandEncoder,
    sheet: &Sheet,
    pipelines: &[wgpu::RenderPipeline],
    [vertices, indices]: &[wgpu::Buffer; 2],
    Attachments { color, depth, averages }: &Attachments,
) {
    let view = |texture: &wgpu::Texture| texture.create_view(&wgpu::TextureViewDescriptor::default());
    let (color_view, depth_view, averages_view) = (view(color), depth.as_ref().map(view), averages.as_ref().map(view));
    let load = wgpu::Operations { load: wgpu::LoadOp::Load, store: wgpu::StoreOp::Store };
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &color_view,
            depth_slice: None,
            resolve_target: averages_view.as_ref(),
            ops: load,
        })],
        depth_stencil_attachment: depth_view.as_ref().map(|view| wgpu::RenderPassDepthStencilAttachment {
            view,
            depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Store }),
            stencil_ops: (!sheet.stencil.is_empty())
                .then_some(wgpu::Operations { load: wgpu::LoadOp::Load, store: wgpu::StoreOp::Store }),
        }),
        ..wgpu::RenderPassDescriptor::default()
    });
    pass.set_vertex_buffer(0, vertices.slice(..));
    pass.set_index_buffer(indices.slice(..), wgpu::IndexFormat::Uint32);
    let (mut first_vertex, mut first_index) = (0, 0);
    for (draw, pipeline) in sheet.draws.iter().zip(pipelines) {
        let state = &draw.state;
        let viewport = state.viewport.unwrap_or(sheet.viewport());
        let top = viewport.y + viewport.height.min(0.0);
        let (width, height) = (viewport.width, viewport.height.abs());
        pass.set_viewport(viewport.x, top, width, height, viewport.min_depth, viewport.max_depth);
        let (x, y, width, height) = state.scissor.map_or((0, 0, sheet.side, sheet.side), |scissor| {
            (scissor.x as u32, scissor.y as u32, scissor.width, scissor.height)
        });
        pass.set_scissor_rect(x, y, width, height);
        let [r, g, b, a] = state.blend.constant.map(f64::from);
        pass.set_blend_constant(wgpu::Color { r, g, b, a });
        pass.set_stencil_reference(state.stencil.map_or(0, |stencil| stencil.front.reference.into()));
        pass.set_pipeline(pipeline);
        let count = draw.vertices.len() as u32;
        match &draw.indices {
            None => pass.draw(first_vertex..first_vertex + count, 0..1),
            Some(indices) => {
                let end = first_index + indices.len() as u32;
                pass.draw_indexed(first_index..end, first_vertex as i32, 0..1);
                first_index = end;
            }
        }
        first_vertex += count;
    }
}

fn copy(
    encoder: &mut wgpu::CommandEncoder,
    sheet: &Sheet,
    texture: &wgpu::Texture,
    aspect: wgpu::TextureAspect,
    buffer: &wgpu::Buffer,
) {
    let bytes_per_row = Some((buffer.size() / u64::from(sheet.side)) as u32);
    let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row, rows_per_image: None };
    encoder.copy_texture_to_buffer(
        wgpu::TexelCopyTextureInfo { aspect, ..texture.as_image_copy() },
        wgpu::TexelCopyBufferInfo { buffer, layout },
        size(sheet),
    );
}

fn size(sheet: &Sheet) -> wgpu::Extent3d {
    wgpu::Extent3d { width: sheet.side, height: sheet.side, depth_or_array_layers: 1 }
}

/// A unorm format's codes from the bits of the f32s that a shader loads.
fn stored(format: DepthFormat, bits: Vec<u32>) -> Vec<u32> {
    let Some(steps) = format.steps() else { return bits };
    bits.into_iter().map(|bits| (f64::from(f32::from_bits(bits)) * f64::from(steps)).round() as u32).collect()
}
