//! The whole crate as a WebAssembly module: a picture of one vessel in one volume, in a browser with WebGPU.
//!
//! `cargo build -p lumencut-gpu --example web --profile wasm --target wasm32-unknown-unknown`; wasm-bindgen's command
//! line makes the module and its JavaScript of it. On other targets there is nothing in it.
#![cfg(target_arch = "wasm32")]

use std::sync::Arc;

use lumencut_core::camera::Camera;
use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::pipeline::Request;
use lumencut_core::scene::Scene;
use lumencut_core::settings::Settings;
use lumencut_core::vessel_tree::{Vessel, VesselTree};
use lumencut_core::volume::{Volume, Voxels};
use lumencut_gpu::adapter::Choice;
use lumencut_gpu::device::Device;
use lumencut_gpu::renderer::GpuRenderer;
use wasm_bindgen::prelude::{JsError, wasm_bindgen};

/// Draws `voxels`, which lie i fastest, with sides of `spacing` mm, along one vessel through `points` (x, y, z in mm, one
/// after the other; the first voxel is at the origin), seen along y: `width` × `height` pixels of RGBA, row 0 on top.
///
/// # Errors
/// In words, as [`GpuRenderer::render`].
#[wasm_bindgen]
pub async fn render(
    voxels: Vec<i16>,
    size: Vec<usize>,
    spacing: f64,
    points: Vec<f64>,
    width: usize,
    height: usize,
) -> std::result::Result<Vec<u8>, JsError> {
    let picture = picture(&voxels, &size, spacing, &points, [width, height]).await;
    picture.map_err(|error| JsError::new(&error.to_string()))
}

// In a browser nothing of the GPU leaves its thread.
#[allow(clippy::arc_with_non_send_sync)]
async fn picture(
    voxels: &[i16],
    size: &[usize],
    spacing: f64,
    points: &[f64],
    pixels: [usize; 2],
) -> Result<Vec<u8>> {
    let &[ni, nj, nk] = size else {
        let found = format!("{} numbers", size.len());
        return Err(Error::new(ErrorKind::Volume, "size", found, "the voxels along i, j and k"));
    };
    let world_from_index = glam::DAffine3::from_scale(glam::DVec3::splat(spacing));
    let volume = Volume::new(Voxels::I16(voxels), [ni, nj, nk], [1, ni, ni * nj], world_from_index)?;
    let points = points.chunks_exact(3).map(glam::DVec3::from_slice).collect();
    let tree = VesselTree::new(vec![Vessel::new(points, None)?])?;
    let center = volume.corners().iter().sum::<glam::DVec3>() / 8.0;
    let pixel_spacing = volume.longest_way() / pixels[1].max(1) as f64;
    let camera = Camera::new(center, glam::DVec3::Y, glam::DVec3::Z, pixels, pixel_spacing)?;
    let device = Arc::new(Device::open(Choice::Any).await?);
    let (scene, settings) = (Scene::new(volume, tree), Settings::default());
    let frame = GpuRenderer::new(device).render(&scene, &Request::new(&camera, &settings)).await?;
    Ok(frame.image.into_flattened())
}
