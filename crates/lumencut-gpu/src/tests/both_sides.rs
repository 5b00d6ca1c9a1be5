//! Renders one scene on the GPU and on the CPU, and compares the frames.

use std::sync::Arc;

use lumencut_core::camera::Camera;
use lumencut_core::frame::Frame;
use lumencut_core::pipeline::{CpuRenderer, Request};
use lumencut_core::scene::Scene;
use lumencut_core::settings::Settings;
use lumencut_core::stages::rim::RimColors;
use lumencut_core::stages::steady::Before;
use lumencut_phantom::Phantom;
use lumencut_scenes::compare::assert_equal;
use lumencut_scenes::tolerances::{CONTEXT_OF_FRAME, DISTANCE};

use super::ties;
use crate::device::Device;
use crate::renderer::GpuRenderer;

pub(crate) struct BothSides {
    pub phantom: Phantom,
    pub gpu: GpuRenderer,
}

impl BothSides {
    pub(super) fn new(device: &Arc<Device>, phantom: Phantom) -> Self {
        Self { phantom, gpu: GpuRenderer::new(Arc::clone(device)) }
    }

    pub(super) fn scene(&self) -> Scene<'_> {
        Scene::new(self.phantom.volume().unwrap(), self.phantom.tree.clone())
    }

    pub(super) fn on_gpu(&mut self, camera: &Camera, settings: &Settings) -> Frame {
        let scene = Scene::new(self.phantom.volume().unwrap(), self.phantom.tree.clone());
        let colors = self.colors();
        let depth = vec![0.0; camera.size().iter().product()];
        // It counts only with a `turning_limit`.
        let before = Some(Before { camera, depth: &depth });
        let request = Request { rim: Some(&colors), before, ..Request::new(camera, settings) };
        pollster::block_on(self.gpu.render(&scene, &request)).unwrap()
    }

    pub(super) fn on_cpu(&self, camera: &Camera, settings: &Settings) -> Frame {
        let colors = self.colors();
        let depth = vec![0.0; camera.size().iter().product()];
        // It counts only with a `turning_limit`.
        let before = Some(Before { camera, depth: &depth });
        let request = Request { rim: Some(&colors), before, ..Request::new(camera, settings) };
        CpuRenderer::default().render(&self.scene(), &request).unwrap()
    }

    /// Colours for a rim, which change along each vessel.
    fn colors(&self) -> RimColors {
        let vessel = |n: usize| (0..50).map(|k| [5 * k, 255 - 4 * k, 40 * n as u8, 255]).collect();
        RimColors::new(&(0..self.phantom.tree.vessels().len()).map(vessel).collect::<Vec<_>>())
    }

    pub(super) fn check(&mut self, camera: &Camera, settings: &Settings) {
        let (gpu, cpu) = (self.on_gpu(camera, settings), self.on_cpu(camera, settings));
        self.assert_same(gpu, &cpu, settings);
    }

    /// As [`assert_same`], but accepts pixels around joints where vessels tie.
    pub(super) fn assert_same(&self, mut gpu: Frame, cpu: &Frame, settings: &Settings) {
        ties::excuse(&mut gpu, cpu, &self.phantom.tree, settings);
        assert_same(&gpu, cpu);
    }
}

/// Asserts that picture, cut surface, distance and context are equal up to rounding.
pub(crate) fn assert_same(gpu: &Frame, cpu: &Frame) {
    assert_equal(gpu, cpu);
    assert_eq!(gpu.value.len(), cpu.value.len());
    DISTANCE.assert_same(&gpu.distance, &cpu.distance, "distances");
    assert_eq!(gpu.context.len(), cpu.context.len());
    let is_same = |a: u8, b: u8| CONTEXT_OF_FRAME.is_same(f32::from(a), f32::from(b));
    let apart = |(a, b): (&[u8; 4], &[u8; 4])| (0..4).any(|c| !is_same(a[c], b[c]));
    let leaps = gpu.context.iter().zip(&cpu.context).filter(|pair| apart(*pair)).count();
    assert!(
        CONTEXT_OF_FRAME.allows(leaps, gpu.context.len()),
        "{leaps} of {} pixels of context",
        gpu.context.len()
    );
}
