//! Occlusion on the GPU.

use std::sync::OnceLock;

use lumencut_core::camera::Camera;
use lumencut_core::stages::occlusion::OcclusionParameters;
use wgpu::Buffer;

use crate::depth_filter::GROUP;
use crate::device::Device;
use crate::images::Images;
use crate::recording::Recording;
use crate::stage::Stage;
use crate::view::groups;

const ROOM: &str = "stages/occlusion";

#[derive(Debug)]
pub(crate) struct Occlusion {
    /// Compiled when needed.
    stages: OnceLock<OcclusionStages>,
    parameters: Buffer,
}

#[derive(Debug)]
struct OcclusionStages {
    /// For each blur: the stages that reduce the depth, and blur it along columns and rows.
    blurs: [[Stage; 3]; 2],
    compare: Stage,
}

impl OcclusionStages {
    fn new(device: &Device) -> Self {
        let blurs = [0.0, 1.0].map(|scale| {
            let blur = |down| Stage::entry(device, ROOM, "blur", &[("SCALE", scale), ("DOWN", down)]);
            [Stage::entry(device, ROOM, "reduce", &[("SCALE", scale)]), blur(1.0), blur(0.0)]
        });
        Self { blurs, compare: Stage::new(device, ROOM, &[]) }
    }
}

impl Occlusion {
    pub(crate) fn new(device: &Device) -> Self {
        let parameters = device.uniform::<OcclusionParameters>("occlusion parameters");
        Self { stages: OnceLock::new(), parameters }
    }

    /// Records the stage, which uses three images that later stages overwrite.
    pub(crate) fn record(
        &self,
        recording: &mut Recording,
        view: &Buffer,
        (images, depth): (&Images, &Buffer),
        camera: &Camera,
    ) {
        let device = recording.device;
        let parameters = OcclusionParameters::new(camera);
        device.write(&self.parameters, &[parameters]);
        let OcclusionStages { blurs, compare } = self.stages.get_or_init(|| OcclusionStages::new(device));
        let Images { size, start: columns, strength: near, value: far, focus, .. } = images;
        for ((blur, stages), small) in parameters.blurs.iter().zip(blurs).zip([near, far]) {
            let across = groups(blur.reduced(*size), GROUP);
            for (stage, [from, to]) in stages.iter().zip([[depth, small], [small, columns], [columns, small]])
            {
                let buffers = [view, &self.parameters, from, to].map(Buffer::as_entire_binding);
                recording.run(stage, &buffers, across);
            }
        }
        let buffers = [view, &self.parameters, depth, near, far, focus].map(Buffer::as_entire_binding);
        recording.run(compare, &buffers, groups(*size, GROUP));
    }
}
