//! One file per renderer, behind one trait.

#[cfg(feature = "embree")]
mod embree;
mod euc;
#[cfg(feature = "pineda")]
mod pineda;
#[cfg(feature = "vulkan")]
mod vulkan;

use crate::scene::{Scene, SceneName};
use anyhow::Result;
use clap::ValueEnum;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// Which renderer to draw with.
#[derive(Clone, Copy, Debug, Deserialize, Eq, Ord, PartialEq, PartialOrd, Serialize, ValueEnum)]
#[serde(rename_all = "lowercase")]
#[value(rename_all = "lowercase")]
pub(crate) enum Peer {
    /// This repository's rasterizer: what the others are compared with.
    Pineda,
    /// Mesa's Vulkan driver for CPUs (llvmpipe), through wgpu.
    Lavapipe,
    /// Google's Vulkan driver for CPUs, as Chromium ships it, through wgpu.
    Swiftshader,
    /// Mesa's OpenGL driver for CPUs, the same rasterizer as lavapipe's, through wgpu.
    Llvmpipe,
    /// The Rust crate euc, one thread.
    Euc,
    /// Intel's ray tracer: what is seen through each pixel's middle, by one ray each.
    Embree,
}

/// A renderer that has a scene loaded: vertices uploaded, pipelines built, memory allocated.
pub(crate) trait Backend {
    /// Name, version and instruction set as the renderer itself gives them.
    fn version(&self) -> String;

    /// Clears and draws one frame; on return its output is in the caller's memory.
    fn draw(&mut self) -> Result<()>;

    /// The last frame as 8-bit red, green, blue, alpha, rows from the top: linear colours, depths as [gray](crate::scene::gray), numbers' bytes.
    fn picture(&self) -> Cow<'_, [[u8; 4]]>;
}

impl Peer {
    /// Loads a scene into the renderer, in this process. `threads` matters to renderers that take it as a setting; the others are told by their environment.
    pub(crate) fn load(self, scene: &Scene, threads: usize) -> Result<Box<dyn Backend>> {
        match self {
            Self::Pineda => pineda_backend(scene, threads),
            Self::Lavapipe | Self::Swiftshader | Self::Llvmpipe => wgpu_backend(scene, self),
            Self::Euc => Ok(Box::new(euc::Euc::new(scene))),
            Self::Embree => embree_backend(scene, threads),
        }
    }

    /// Whether it can draw the scene: SwiftShader has no triangles' numbers, OpenGL through wgpu neither those nor depths to give away nor comparisons with depth maps at a level; euc is asked for pictures
    /// of opaque surfaces without textures, in one draw, one sample a pixel, only; Embree says what is seen, and does not shade it.
    pub(crate) fn draws(self, scene: SceneName) -> bool {
        match self {
            Self::Pineda | Self::Lavapipe => true,
            Self::Swiftshader => scene != SceneName::Ids,
            Self::Llvmpipe => !matches!(scene, SceneName::DepthOnly | SceneName::Ids | SceneName::Shadowed),
            Self::Euc => matches!(
                scene,
                SceneName::FillFrontToBack
                    | SceneName::FillBackToFront
                    | SceneName::Micro
                    | SceneName::Medium
                    | SceneName::Knot256
                    | SceneName::Slivers
                    | SceneName::ColdStart
            ),
            Self::Embree => matches!(scene, SceneName::DepthOnly | SceneName::Ids),
        }
    }

    /// How many of so many threads the renderer can make use of.
    pub(crate) fn useful_threads(self, threads: usize) -> usize {
        if self == Self::Euc { 1 } else { threads }
    }

    /// The name as typed on the command line.
    pub(crate) fn as_str(self) -> &'static str {
        match self {
            Self::Pineda => "pineda",
            Self::Lavapipe => "lavapipe",
            Self::Swiftshader => "swiftshader",
            Self::Llvmpipe => "llvmpipe",
            Self::Euc => "euc",
            Self::Embree => "embree",
        }
    }
}

#[cfg(feature = "pineda")]
fn pineda_backend(scene: &Scene, threads: usize) -> Result<Box<dyn Backend>> {
    Ok(Box::new(pineda::Pineda::new(scene, threads)?))
}

#[cfg(not(feature = "pineda"))]
fn pineda_backend(_: &Scene, _: usize) -> Result<Box<dyn Backend>> {
    anyhow::bail!("this build has no pineda; build with the feature `pineda`")
}

#[cfg(feature = "embree")]
fn embree_backend(scene: &Scene, threads: usize) -> Result<Box<dyn Backend>> {
    Ok(Box::new(embree::Embree::new(scene, threads)?))
}

#[cfg(not(feature = "embree"))]
fn embree_backend(_: &Scene, _: usize) -> Result<Box<dyn Backend>> {
    anyhow::bail!("this build has no Embree; build with the feature `embree`")
}

#[cfg(feature = "vulkan")]
fn wgpu_backend(scene: &Scene, peer: Peer) -> Result<Box<dyn Backend>> {
    let backends = if peer == Peer::Llvmpipe { wgpu::Backends::GL } else { wgpu::Backends::VULKAN };
    Ok(Box::new(vulkan::Vulkan::new(scene, backends)?))
}

#[cfg(not(feature = "vulkan"))]
fn wgpu_backend(_: &Scene, _: Peer) -> Result<Box<dyn Backend>> {
    anyhow::bail!("this build has no Vulkan; build with the feature `vulkan`")
}
