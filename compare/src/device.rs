//! A Vulkan (or OpenGL) device through wgpu, headless. Which driver answers is decided by the environment of the process.

use anyhow::{Context, Result};

/// A device that is ready to draw.
pub(crate) struct Device {
    /// Its name and its driver's, with versions.
    pub(crate) version: String,
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
}

impl Device {
    /// Opens the driver's first device, with those of the wanted features that it has.
    pub(crate) fn open(backends: wgpu::Backends, wanted: wgpu::Features) -> Result<Self> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
            backends,
            // No validation, whatever the build; Debian's lavapipe does not claim conformance, which wgpu would otherwise hold against it.
            flags: wgpu::InstanceFlags::ALLOW_UNDERLYING_NONCOMPLIANT_ADAPTER,
            ..wgpu::InstanceDescriptor::new_without_display_handle()
        });
        let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()))
            .context("the driver offers no device")?;
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
            required_features: adapter.features() & wanted,
            required_limits: adapter.limits(),
            ..wgpu::DeviceDescriptor::default()
        }))
        .context("the driver gives no device")?;
        Ok(Self { version: version(&adapter.get_info()), device, queue })
    }
}

/// The device and its driver. SwiftShader's driver does not say its version.
fn version(info: &wgpu::AdapterInfo) -> String {
    let driver = if info.driver_info.is_empty() { &info.driver } else { &info.driver_info };
    format!("{}, {driver}, through wgpu 30", info.name)
}
