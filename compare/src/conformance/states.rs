//! `pineda`'s draw states in WebGPU's words. They are nearly the same; a render pipeline is made for each that is asked for.

use super::sheet::{Colors, DepthFormat, Draw, Interpolation, Sheet, Vertex};
use pineda::{
    BlendComponent, BlendFactor, BlendOperation, ColorMask, Compare, Cull, FrontFace, PrimitiveTopology, StencilFace,
    StencilOperation,
};

/// The pipeline for a draw to a sheet.
pub(crate) fn pipeline(
    device: &wgpu::Device,
    module: &wgpu::ShaderModule,
    draw: &Draw,
    sheet: &Sheet,
) -> wgpu::RenderPipeline {
    let state = &draw.state;
    let (vertex, fragment) = match draw.interpolation {
        Interpolation::Perspective => ("perspective_vertex", "perspective_fragment"),
        Interpolation::Linear => ("linear_vertex", "linear_fragment"),
        Interpolation::Flat => ("flat_vertex", "flat_fragment"),
    };
    let blend = (state.blend != pineda::Blend::OPAQUE).then(|| wgpu::BlendState {
        color: blend_component(state.blend.color),
        alpha: blend_component(state.blend.alpha),
    });
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: None,
        layout: None,
        vertex: wgpu::VertexState {
            module,
            entry_point: Some(vertex),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[Some(wgpu::VertexBufferLayout {
                array_stride: size_of::<Vertex>() as u64,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes: &wgpu::vertex_attr_array![0 => Float32x4, 1 => Float32x4],
            })],
        },
        primitive: wgpu::PrimitiveState {
            topology: topology(state.topology),
            strip_index_format: (topology(state.topology).is_strip() && draw.indices.is_some())
                .then_some(wgpu::IndexFormat::Uint32),
            front_face: match state.front_face {
                FrontFace::CounterClockwise => wgpu::FrontFace::Ccw,
                FrontFace::Clockwise => wgpu::FrontFace::Cw,
            },
            cull_mode: match state.cull {
                Cull::None => None,
                Cull::Front => Some(wgpu::Face::Front),
                Cull::Back => Some(wgpu::Face::Back),
            },
            unclipped_depth: state.depth_clamp,
            ..wgpu::PrimitiveState::default()
        },
        depth_stencil: depth_format(sheet.depth).map(|format| wgpu::DepthStencilState {
            format,
            depth_write_enabled: Some(state.depth.write),
            depth_compare: Some(compare(state.depth.compare)),
            stencil: state.stencil.map_or_else(wgpu::StencilState::default, |stencil| wgpu::StencilState {
                front: stencil_face(stencil.front),
                back: stencil_face(stencil.back),
                read_mask: stencil.front.read_mask.into(),
                write_mask: stencil.front.write_mask.into(),
            }),
            bias: wgpu::DepthBiasState {
                constant: state.depth_bias.constant as i32,
                slope_scale: state.depth_bias.slope,
                clamp: state.depth_bias.clamp,
            },
        }),
        multisample: wgpu::MultisampleState {
            count: sheet.samples.count(),
            mask: state.sample_mask.into(),
            alpha_to_coverage_enabled: state.alpha_to_coverage,
        },
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some(fragment),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(wgpu::ColorTargetState {
                format: color_format(&sheet.colors),
                blend,
                write_mask: color_writes(state.color_mask),
            })],
        }),
        multiview_mask: None,
        cache: None,
    })
}

/// WebGPU has no fans and no loops, and none is asked for.
fn topology(topology: PrimitiveTopology) -> wgpu::PrimitiveTopology {
    match topology {
        PrimitiveTopology::PointList => wgpu::PrimitiveTopology::PointList,
        PrimitiveTopology::LineList => wgpu::PrimitiveTopology::LineList,
        PrimitiveTopology::LineStrip => wgpu::PrimitiveTopology::LineStrip,
        PrimitiveTopology::TriangleStrip => wgpu::PrimitiveTopology::TriangleStrip,
        _ => wgpu::PrimitiveTopology::TriangleList,
    }
}

pub(crate) fn color_format(colors: &Colors) -> wgpu::TextureFormat {
    match colors {
        Colors::Unorm8(_) => wgpu::TextureFormat::Rgba8Unorm,
        Colors::Srgb8(_) => wgpu::TextureFormat::Rgba8UnormSrgb,
        Colors::Float16(_) => wgpu::TextureFormat::Rgba16Float,
        Colors::Float32(_) => wgpu::TextureFormat::Rgba32Float,
    }
}

pub(crate) fn depth_format(depth: DepthFormat) -> Option<wgpu::TextureFormat> {
    match depth {
        DepthFormat::None => None,
        DepthFormat::Float32 => Some(wgpu::TextureFormat::Depth32Float),
        DepthFormat::Unorm24 => Some(wgpu::TextureFormat::Depth24Plus),
        DepthFormat::Unorm16 => Some(wgpu::TextureFormat::Depth16Unorm),
        DepthFormat::Unorm24Stencil8 => Some(wgpu::TextureFormat::Depth24PlusStencil8),
    }
}

fn color_writes(ColorMask { r, g, b, a }: ColorMask) -> wgpu::ColorWrites {
    use wgpu::ColorWrites as Writes;
    let channels = [(r, Writes::RED), (g, Writes::GREEN), (b, Writes::BLUE), (a, Writes::ALPHA)];
    channels.into_iter().filter(|(written, _)| *written).map(|(_, channel)| channel).collect()
}

fn blend_component(component: BlendComponent) -> wgpu::BlendComponent {
    wgpu::BlendComponent {
        src_factor: factor(component.source),
        dst_factor: factor(component.target),
        operation: match component.operation {
            BlendOperation::Add => wgpu::BlendOperation::Add,
            BlendOperation::Subtract => wgpu::BlendOperation::Subtract,
            BlendOperation::ReverseSubtract => wgpu::BlendOperation::ReverseSubtract,
            BlendOperation::Min => wgpu::BlendOperation::Min,
            BlendOperation::Max => wgpu::BlendOperation::Max,
        },
    }
}

/// WebGPU has one constant of four channels: of a colour's channel its red, green or blue, of alpha its alpha, as with `pineda`'s `Constant`.
/// `ConstantAlpha`, which it has not, is never asked for.
fn factor(factor: BlendFactor) -> wgpu::BlendFactor {
    match factor {
        BlendFactor::Zero => wgpu::BlendFactor::Zero,
        BlendFactor::One => wgpu::BlendFactor::One,
        BlendFactor::Source => wgpu::BlendFactor::Src,
        BlendFactor::OneMinusSource => wgpu::BlendFactor::OneMinusSrc,
        BlendFactor::SourceAlpha => wgpu::BlendFactor::SrcAlpha,
        BlendFactor::OneMinusSourceAlpha => wgpu::BlendFactor::OneMinusSrcAlpha,
        BlendFactor::Target => wgpu::BlendFactor::Dst,
        BlendFactor::OneMinusTarget => wgpu::BlendFactor::OneMinusDst,
        BlendFactor::TargetAlpha => wgpu::BlendFactor::DstAlpha,
        BlendFactor::OneMinusTargetAlpha => wgpu::BlendFactor::OneMinusDstAlpha,
        BlendFactor::SourceAlphaSaturated => wgpu::BlendFactor::SrcAlphaSaturated,
        BlendFactor::Constant | BlendFactor::ConstantAlpha => wgpu::BlendFactor::Constant,
        BlendFactor::OneMinusConstant | BlendFactor::OneMinusConstantAlpha => wgpu::BlendFactor::OneMinusConstant,
        BlendFactor::Source1 => wgpu::BlendFactor::Src1,
        BlendFactor::OneMinusSource1 => wgpu::BlendFactor::OneMinusSrc1,
        BlendFactor::Source1Alpha => wgpu::BlendFactor::Src1Alpha,
        BlendFactor::OneMinusSource1Alpha => wgpu::BlendFactor::OneMinusSrc1Alpha,
    }
}

pub(super) fn compare(compare: Compare) -> wgpu::CompareFunction {
    match compare {
        Compare::Never => wgpu::CompareFunction::Never,
        Compare::Less => wgpu::CompareFunction::Less,
        Compare::Equal => wgpu::CompareFunction::Equal,
        Compare::LessEqual => wgpu::CompareFunction::LessEqual,
        Compare::Greater => wgpu::CompareFunction::Greater,
        Compare::NotEqual => wgpu::CompareFunction::NotEqual,
        Compare::GreaterEqual => wgpu::CompareFunction::GreaterEqual,
        Compare::Always => wgpu::CompareFunction::Always,
    }
}

fn stencil_face(face: StencilFace) -> wgpu::StencilFaceState {
    wgpu::StencilFaceState {
        compare: compare(face.compare),
        fail_op: stencil_operation(face.fail),
        depth_fail_op: stencil_operation(face.depth_fail),
        pass_op: stencil_operation(face.pass),
    }
}

fn stencil_operation(operation: StencilOperation) -> wgpu::StencilOperation {
    match operation {
        StencilOperation::Keep => wgpu::StencilOperation::Keep,
        StencilOperation::Zero => wgpu::StencilOperation::Zero,
        StencilOperation::Replace => wgpu::StencilOperation::Replace,
        StencilOperation::IncrementClamp => wgpu::StencilOperation::IncrementClamp,
        StencilOperation::DecrementClamp => wgpu::StencilOperation::DecrementClamp,
        StencilOperation::Invert => wgpu::StencilOperation::Invert,
        StencilOperation::IncrementWrap => wgpu::StencilOperation::IncrementWrap,
        StencilOperation::DecrementWrap => wgpu::StencilOperation::DecrementWrap,
    }
}
