//! Textures looked up by a Vulkan driver: place by place, or on triangles.

use super::super::lookups::{Format, How, Kind, Lookups, Surfaces, Texture};
use super::super::sheet::Vertex;
use super::super::states::compare;
use super::Theirs;
use crate::device::Device;
use anyhow::{Result, ensure};
use pineda::{Filter, MipFilter, Sampler, Wrap};
use wgpu::util::{BufferInitDescriptor, DeviceExt, TextureDataOrder};

/// Pixels to each side.
pub(crate) const SIDE: u32 = 256;

const LAYOUT: wgpu::VertexBufferLayout<'_> = wgpu::VertexBufferLayout {
    array_stride: size_of::<Vertex>() as u64,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![0 => Float32x4, 1 => Float32x4],
};

/// What is drawn.
enum Geometry<'a> {
    /// The whole picture: a buffer of places, and the fragment stage that looks them up.
    Places(&'a wgpu::Buffer, &'a str),
    /// Vertices.
    Triangles(&'a wgpu::Buffer),
}

impl Theirs {
    /// Whether textures of f32 can be filtered.
    pub(crate) fn filters_floats(&self) -> bool {
        self.device.device.features().contains(wgpu::Features::FLOAT32_FILTERABLE)
    }

    /// What the driver finds at each place: as many as the picture has pixels.
    pub(crate) fn look_up(&self, Lookups { texture, sampler, how, places }: &Lookups) -> Result<Vec<[f32; 4]>> {
        ensure!(places.len() == (SIDE * SIDE) as usize, "a place for each pixel");
        let kind = match texture.kind {
            Kind::Flat => "flat",
            Kind::Array => "array",
            Kind::Cube => "cube",
            Kind::Volume => "volume",
        };
        let how = match how {
            How::Level => "level",
            How::Gradient => "gradient",
            How::Compare => "compare",
        };
        let buffer = self.filled(bytemuck::cast_slice(places), wgpu::BufferUsages::STORAGE);
        self.draw_textured(&Geometry::Places(&buffer, &format!("{kind}_{how}")), texture, sampler)
    }

    /// A picture of textured triangles.
    pub(crate) fn draw_surfaces(&self, Surfaces { texture, sampler, vertices }: &Surfaces) -> Result<Vec<[f32; 4]>> {
        let buffer = self.filled(bytemuck::cast_slice(vertices), wgpu::BufferUsages::VERTEX);
        self.draw_textured(&Geometry::Triangles(&buffer), texture, sampler)
    }

    fn filled(&self, contents: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
        self.device.device.create_buffer_init(&BufferInitDescriptor { label: None, contents, usage })
    }

    fn draw_textured(&self, geometry: &Geometry<'_>, texture: &Texture, sampler: &Sampler) -> Result<Vec<[f32; 4]>> {
        let (vertex, fragment, buffers): (_, _, &[_]) = match geometry {
            Geometry::Places(_, fragment) => ("whole_picture", *fragment, &[]),
            Geometry::Triangles(_) => ("surface", "on_surface", &[Some(LAYOUT)]),
        };
        let device = &self.device.device;
        let format = wgpu::TextureFormat::Rgba32Float;
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: None,
            layout: None,
            vertex: wgpu::VertexState {
                module: &self.lookups,
                entry_point: Some(vertex),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers,
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &self.lookups,
                entry_point: Some(fragment),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &[Some(format.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        let view = self.uploaded(texture);
        let sampler = device.create_sampler(&descriptor(sampler, texture.format == Format::Depth16));
        let mut entries = vec![
            wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::Sampler(&sampler) },
            wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::TextureView(&view) },
        ];
        if let Geometry::Places(places, _) = geometry {
            entries.push(wgpu::BindGroupEntry { binding: 0, resource: places.as_entire_binding() });
        }
        let layout = &pipeline.get_bind_group_layout(0);
        let bindings = device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries: &entries });

        let size = wgpu::Extent3d { width: SIDE, height: SIDE, depth_or_array_layers: 1 };
        let target = device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size,
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let target_view = target.create_view(&wgpu::TextureViewDescriptor::default());
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &target_view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                    store: wgpu::StoreOp::Store,
                },
            })],
            ..wgpu::RenderPassDescriptor::default()
        });
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &bindings, &[]);
        match geometry {
            Geometry::Places(..) => pass.draw(0..3, 0..1),
            Geometry::Triangles(vertices) => {
                pass.set_vertex_buffer(0, vertices.slice(..));
                pass.draw(0..(vertices.size() / size_of::<Vertex>() as u64) as u32, 0..1);
            }
        }
        drop(pass);
        let readback = self.readback(u64::from(SIDE * SIDE) * 16);
        let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(SIDE * 16), rows_per_image: None };
        encoder.copy_texture_to_buffer(
            target.as_image_copy(),
            wgpu::TexelCopyBufferInfo { buffer: &readback, layout },
            size,
        );
        self.device.queue.submit([encoder.finish()]);
        Ok(bytemuck::pod_collect_to_vec(&self.read(&readback)?))
    }

    fn uploaded(&self, texture: &Texture) -> wgpu::TextureView {
        let [width, height, slices] = texture.size;
        let (dimension, view) = match texture.kind {
            Kind::Flat => (wgpu::TextureDimension::D2, wgpu::TextureViewDimension::D2),
            Kind::Array => (wgpu::TextureDimension::D2, wgpu::TextureViewDimension::D2Array),
            Kind::Cube => (wgpu::TextureDimension::D2, wgpu::TextureViewDimension::Cube),
            Kind::Volume => (wgpu::TextureDimension::D3, wgpu::TextureViewDimension::D3),
        };
        let format = match texture.format {
            Format::R8 => wgpu::TextureFormat::R8Unorm,
            Format::Rg8 => wgpu::TextureFormat::Rg8Unorm,
            Format::Rgba8 => wgpu::TextureFormat::Rgba8Unorm,
            Format::Rgba8Srgb => wgpu::TextureFormat::Rgba8UnormSrgb,
            Format::R16F => wgpu::TextureFormat::R16Float,
            Format::Rgba16F => wgpu::TextureFormat::Rgba16Float,
            Format::R32F => wgpu::TextureFormat::R32Float,
            Format::Rgba32F => wgpu::TextureFormat::Rgba32Float,
            Format::Depth16 => wgpu::TextureFormat::Depth16Unorm,
        };
        let descriptor = wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d { width, height, depth_or_array_layers: slices },
            mip_level_count: texture.levels,
            sample_count: 1,
            dimension,
            format,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        };
        let Device { device, queue, .. } = &self.device;
        let uploaded = device.create_texture_with_data(queue, &descriptor, TextureDataOrder::MipMajor, &texture.bytes);
        uploaded.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(view),
            ..wgpu::TextureViewDescriptor::default()
        })
    }
}

fn descriptor(sampler: &Sampler, is_compared: bool) -> wgpu::SamplerDescriptor<'static> {
    let [u, v, w] = sampler.wrap.map(|wrap| match wrap {
        Wrap::Repeat => wgpu::AddressMode::Repeat,
        Wrap::Mirror => wgpu::AddressMode::MirrorRepeat,
        Wrap::Clamp => wgpu::AddressMode::ClampToEdge,
        Wrap::Border => wgpu::AddressMode::ClampToBorder,
    });
    let filter = |filter| match filter {
        Filter::Nearest => wgpu::FilterMode::Nearest,
        Filter::Linear => wgpu::FilterMode::Linear,
    };
    wgpu::SamplerDescriptor {
        address_mode_u: u,
        address_mode_v: v,
        address_mode_w: w,
        mag_filter: filter(sampler.mag_filter),
        min_filter: filter(sampler.min_filter),
        mipmap_filter: match sampler.mip_filter {
            MipFilter::Base | MipFilter::Nearest => wgpu::MipmapFilterMode::Nearest,
            MipFilter::Linear => wgpu::MipmapFilterMode::Linear,
        },
        lod_min_clamp: sampler.lod_min,
        // Vulkan's way to say that level 0 is all there is (VkSamplerCreateInfo): what is magnified is told from what is minified at 0, the level at 1/2.
        lod_max_clamp: if sampler.mip_filter == MipFilter::Base { 0.25 } else { sampler.lod_max.min(32.0) },
        compare: is_compared.then(|| compare(sampler.compare)),
        border_color: (sampler.wrap.contains(&Wrap::Border)).then_some(wgpu::SamplerBorderColor::OpaqueWhite),
        ..wgpu::SamplerDescriptor::default()
    }
}
