//! The stages of `lumencut-core` as WGSL through wgpu: Vulkan, Metal, DirectX 12, and WebGPU in the browser.
//!
//! Every stage is a shader that lies next to the core's Rust file, under the same name. The pictures equal
//! those of the CPU up to rounding.

pub mod adapter;
mod blocks;
mod body;
mod composite;
mod context;
mod cut_surface;
mod depth_filter;
pub mod device;
mod far_rim;
mod images;
mod leap;
mod levels;
mod occlusion;
#[cfg(not(target_arch = "wasm32"))]
mod on_cpu;
mod pass;
#[cfg(not(target_arch = "wasm32"))]
mod pass_on_cpu;
mod recording;
pub mod renderer;
mod rim;
#[cfg(target_arch = "wasm32")]
pub mod screen;
mod silhouette;
pub mod stage;
pub mod stages;
mod steady;
mod surface;
#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests;
mod view;
mod volume;
#[cfg(not(target_arch = "wasm32"))]
pub mod wall;
