//! The stages of `lumencut-core` as WGSL through wgpu: Vulkan, Metal, DirectX 12, and WebGPU in the browser.
//!
//! Every stage is the shader beside the core's own, under the same name; the pictures are those of the CPU but for
//! rounding.

pub mod adapter;
#[allow(dead_code)]
mod blocks;
#[allow(dead_code)]
mod context;
#[allow(dead_code)]
pub mod device;
#[allow(dead_code)]
mod recording;
pub mod shader;
#[allow(dead_code)]
mod stage;
#[allow(dead_code)]
mod surface;
#[cfg(test)]
mod tests;
#[allow(dead_code)]
pub mod view;
#[allow(dead_code)]
mod volume;
