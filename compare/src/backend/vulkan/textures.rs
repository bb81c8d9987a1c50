//! The scenes' textures, and how they are sampled.

use crate::scene::{Scene, Shading, TEXTURE_SIZE, Texture};
use wgpu::util::{DeviceExt, TextureDataOrder};

/// What a scene's shader binds beside its uniforms.
pub(super) struct Textures {
    colors: Vec<wgpu::TextureView>,
    trilinear: wgpu::Sampler,
    shadow_map: Option<wgpu::TextureView>,
    comparison: wgpu::Sampler,
}

impl Textures {
    pub(super) fn new(device: &wgpu::Device, queue: &wgpu::Queue, scene: &Scene) -> Self {
        let repeat = wgpu::SamplerDescriptor {
            address_mode_u: wgpu::AddressMode::Repeat,
            address_mode_v: wgpu::AddressMode::Repeat,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..wgpu::SamplerDescriptor::default()
        };
        let anisotropy_clamp = if scene.shading == Shading::Floor { 16 } else { 1 };
        let comparison = wgpu::SamplerDescriptor { compare: Some(wgpu::CompareFunction::LessEqual), ..repeat.clone() };
        let shadow_map = (!scene.shadow_map.is_empty()).then(|| {
            let format = wgpu::TextureFormat::Depth16Unorm;
            upload(device, queue, format, 1, bytemuck::cast_slice(&scene.shadow_map))
        });
        let color = |Texture { levels }: &Texture| {
            let format = wgpu::TextureFormat::Rgba8Unorm;
            upload(device, queue, format, levels.len() as u32, bytemuck::cast_slice(&levels.concat()))
        };
        Self {
            colors: scene.textures.iter().map(color).collect(),
            trilinear: device.create_sampler(&wgpu::SamplerDescriptor { anisotropy_clamp, ..repeat }),
            shadow_map,
            comparison: device.create_sampler(&comparison),
        }
    }

    /// Those that the scene's shader declares, and no others.
    pub(super) fn bindings(&self) -> Vec<wgpu::BindGroupEntry<'_>> {
        let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
        let mut entries = Vec::new();
        if !self.colors.is_empty() {
            entries.push(entry(1, wgpu::BindingResource::Sampler(&self.trilinear)));
        }
        for (binding, view) in (2..).zip(&self.colors) {
            entries.push(entry(binding, wgpu::BindingResource::TextureView(view)));
        }
        if let Some(view) = &self.shadow_map {
            entries.push(entry(7, wgpu::BindingResource::TextureView(view)));
            entries.push(entry(8, wgpu::BindingResource::Sampler(&self.comparison)));
        }
        entries
    }
}

fn upload(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    format: wgpu::TextureFormat,
    levels: u32,
    bytes: &[u8],
) -> wgpu::TextureView {
    let descriptor = wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width: TEXTURE_SIZE, height: TEXTURE_SIZE, depth_or_array_layers: 1 },
        mip_level_count: levels,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    };
    let texture = device.create_texture_with_data(queue, &descriptor, TextureDataOrder::LayerMajor, bytes);
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}
