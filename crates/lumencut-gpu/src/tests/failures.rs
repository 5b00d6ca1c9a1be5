//! The errors of a renderer whose GPU is lost or too small, or that is asked to stop.

use std::pin::pin;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::task::{Context, Waker};

use lumencut_core::camera::MAX_PIXELS;
use lumencut_core::error::{Error, ErrorKind, Mend};
use lumencut_core::frame::Frame;
use lumencut_core::pipeline::Request;
use lumencut_core::scene::Scene;
use lumencut_core::settings::Settings;
use lumencut_core::stop::Stop;
use lumencut_phantom::{Phantom, straight_tube};
use lumencut_scenes::views::front;

use super::shared;
use crate::adapter::Choice;
use crate::device::Device;
use crate::renderer::GpuRenderer;

fn scene(phantom: &Phantom) -> Scene<'_> {
    Scene::new(phantom.volume().unwrap(), phantom.tree.clone())
}

fn render(renderer: &mut GpuRenderer, scene: &Scene, stop: Stop) -> Result<Frame, Error> {
    let (camera, settings) = (front([96, 80], 0.8), Settings::default());
    pollster::block_on(renderer.render(scene, &Request { stop, ..Request::new(&camera, &settings) }))
}

/// Asserts that an error of the GPU is one line, and that its remedy is the CPU.
fn check(error: &Error) {
    let line = error.to_string();
    assert_eq!(error.kind, ErrorKind::Device, "{line}");
    assert!(error.mended_by == Some(Mend::Cpu) && !line.contains('\n'), "{line}");
}

#[test]
fn a_lost_gpu_is_an_error_before_and_after_the_first_view() {
    if shared().is_none() {
        return;
    }
    let phantom = straight_tube().unwrap();
    let scene = scene(&phantom);
    for views_before in [0, 1] {
        let device = Arc::new(pollster::block_on(Device::open(Choice::Any)).unwrap());
        let mut renderer = GpuRenderer::new(Arc::clone(&device));
        for _ in 0..views_before {
            render(&mut renderer, &scene, &|| false).unwrap();
        }
        let mut loss = pin!(device.loss());
        let mut has_ended = || loss.as_mut().poll(&mut Context::from_waker(Waker::noop())).is_ready();
        assert!(!has_ended());
        device.lose();
        for _ in 0..2 {
            check(&render(&mut renderer, &scene, &|| false).unwrap_err());
            // The driver reports the loss when polled; from then on the device stays lost.
            let _ = device.device.poll(wgpu::PollType::Poll);
            check(&device.check().unwrap_err());
            assert!(device.is_lost());
        }
        // Callers that wait are woken, and later ones do not wait.
        assert!(has_ended());
        pollster::block_on(device.loss());
        // A new renderer on the lost GPU fails too.
        let mut late = GpuRenderer::new(device);
        check(&render(&mut late, &scene, &|| false).unwrap_err());
    }
}

#[test]
fn a_picture_too_large_for_the_buffers_is_refused_by_its_size() {
    let Some(device) = shared() else { return };
    let most = device.limits.max_storage_buffer_binding_size as usize / 16;
    if most >= MAX_PIXELS {
        println!("no picture is too large for {}", device.description().name);
        return;
    }
    let phantom = straight_tube().unwrap();
    let scene = scene(&phantom);
    let mut renderer = GpuRenderer::new(Arc::clone(device));
    let camera = front([most / 4096 + 1, 4096], 0.01);
    let settings = Settings::default();
    let error = pollster::block_on(renderer.render(&scene, &Request::new(&camera, &settings))).unwrap_err();
    check(&error);
    assert_eq!(error.found, format!("{} × 4096 pixels", most / 4096 + 1));
    assert!(error.expected.contains(&format!("at most {most} pixels")), "{error}");
    // After the error, the renderer still works.
    render(&mut renderer, &scene, &|| false).unwrap();
}

#[test]
fn a_renderer_that_was_stopped_renders_again() {
    let Some(device) = shared() else { return };
    let phantom = straight_tube().unwrap();
    let scene = scene(&phantom);
    let mut renderer = GpuRenderer::new(Arc::clone(device));
    let mut fresh = GpuRenderer::new(Arc::clone(device));
    let expected = render(&mut fresh, &scene, &|| false).unwrap();
    // Stops at the first, second, third … poll, while it sends the volume or waits.
    for patience in 0..6 {
        let asked = AtomicUsize::new(0);
        let stop = || asked.fetch_add(1, Ordering::Relaxed) >= patience;
        match render(&mut renderer, &scene, &stop) {
            Err(error) => assert_eq!(error.kind, ErrorKind::Interrupted, "{error}"),
            // A fast GPU is done before this number of polls.
            Ok(_) => assert!(patience > 0 && asked.into_inner() <= patience),
        }
    }
    let frame = render(&mut renderer, &scene, &|| false).unwrap();
    assert_eq!((&frame.image, frame.depth()), (&expected.image, expected.depth()));
}
