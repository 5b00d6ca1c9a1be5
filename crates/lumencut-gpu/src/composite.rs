//! The picture on the GPU.

use std::sync::OnceLock;

use lumencut_core::settings::Settings;
use lumencut_core::stages::composite::CompositeParameters;
use wgpu::Buffer;

use crate::depth_filter::GROUP;
use crate::device::Device;
use crate::recording::Recording;
use crate::stage::Stage;
use crate::view::groups;

const ROOM: &str = "stages/composite";

/// Layers from the front to the back; [`lumencut_core::stages::composite::Layers`] explains them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Layers<'a> {
    pub value: Option<&'a Buffer>,
    pub strength: Option<&'a Buffer>,
    pub focus: Option<&'a Buffer>,
    pub rim: Option<&'a Buffer>,
    pub context: Option<&'a Buffer>,
}

#[derive(Debug)]
pub(crate) struct Composite {
    /// A stage for each combination of layers, compiled when needed.
    stages: [OnceLock<Stage>; 32],
    layer: OnceLock<Stage>,
    parameters: Buffer,
    /// Bound in place of a missing layer and never read; white, so that a mistaken read shows.
    nothing: Buffer,
}

impl Composite {
    pub(crate) fn new(device: &Device) -> Self {
        Self {
            stages: Default::default(),
            layer: OnceLock::new(),
            parameters: device.image("composite parameters", 1, size_of::<CompositeParameters>()),
            nothing: device.upload("nothing", &[1f32; 4]),
        }
    }

    pub(crate) fn write(&self, device: &Device, settings: &Settings) {
        device.write(&self.parameters, &[CompositeParameters::new(settings)]);
    }

    pub(crate) fn record(
        &self,
        recording: &mut Recording,
        view: &Buffer,
        size: [usize; 2],
        layers: Layers,
        image: &Buffer,
    ) {
        let device = recording.device;
        let Layers { value, strength, focus, rim, context } = layers;
        let there = [value, strength, focus, rim, context].map(|layer| f64::from(u8::from(layer.is_some())));
        let place = there.iter().fold(0, |place, there| 2 * place + *there as usize);
        let stage = self.stages[place].get_or_init(|| {
            let [has_value, has_strength, has_focus, has_rim, has_context] = there;
            let constants = [
                ("ALONE", 1.0 - has_value),
                ("HAS_STRENGTH", has_strength),
                ("HAS_FOCUS", has_focus),
                ("HAS_RIM", has_rim),
                ("HAS_CONTEXT", has_context),
            ];
            Stage::new(device, ROOM, &constants)
        });
        let or_nothing = |layer: Option<_>| layer.unwrap_or(&self.nothing);
        let [value, strength, focus, rim, context] = [value, strength, focus, rim, context].map(or_nothing);
        let buffers = [view, context, image, &self.parameters, value, strength, focus, rim];
        recording.run(stage, &buffers.map(Buffer::as_entire_binding), groups(size, GROUP));
    }

    pub(crate) fn record_layer(
        &self,
        recording: &mut Recording,
        view: &Buffer,
        size: [usize; 2],
        [gathered, image]: [&Buffer; 2],
    ) {
        let device = recording.device;
        let stage = self.layer.get_or_init(|| Stage::entry(device, ROOM, "layer", &[]));
        let buffers = [view, gathered, image].map(Buffer::as_entire_binding);
        recording.run(stage, &buffers, groups(size, GROUP));
    }
}
