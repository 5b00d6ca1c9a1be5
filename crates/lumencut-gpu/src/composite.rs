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

/// What a picture is made of, from the front to the back.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Layers<'a> {
    /// The volume at the cut surface, where there is one; HUGE where it shows nothing.
    pub value: Option<&'a Buffer>,
    /// Strength of the silhouettes, where they are drawn.
    pub strength: Option<&'a Buffer>,
    /// How much of the surface and its silhouettes is shown, where not all of it is.
    pub focus: Option<&'a Buffer>,
    /// The context, colours times opacity and opacity, where there is one.
    pub context: Option<&'a Buffer>,
}

/// The layers over each other, and the context alone.
#[derive(Debug)]
pub(crate) struct Composite {
    /// With or without each layer, compiled once needed.
    stages: [OnceLock<Stage>; 16],
    layer: OnceLock<Stage>,
    parameters: Buffer,
    /// Bound where a layer is not there, and never read: it is white, so that one would see it.
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

    /// Tells the shader of the settings.
    pub(crate) fn write(&self, device: &Device, settings: &Settings) {
        device.write(&self.parameters, &[CompositeParameters::new(settings)]);
    }

    /// Writes the picture, RGBA with straight alpha, of the layers over the background.
    pub(crate) fn record(
        &self,
        recording: &mut Recording,
        view: &Buffer,
        size: [usize; 2],
        layers: Layers,
        image: &Buffer,
    ) {
        let device = recording.device;
        let Layers { value, strength, focus, context } = layers;
        let there = [value, strength, focus, context].map(|layer| f64::from(u8::from(layer.is_some())));
        let place = there.iter().fold(0, |place, there| 2 * place + *there as usize);
        let stage = self.stages[place].get_or_init(|| {
            let [has_value, has_strength, has_focus, has_context] = there;
            let constants = [
                ("ALONE", 1.0 - has_value),
                ("HAS_STRENGTH", has_strength),
                ("HAS_FOCUS", has_focus),
                ("HAS_CONTEXT", has_context),
            ];
            Stage::new(device, ROOM, &constants)
        });
        let or_nothing = |layer: Option<_>| layer.unwrap_or(&self.nothing);
        let [value, strength, focus, context] = [value, strength, focus, context].map(or_nothing);
        let buffers = [view, context, image, &self.parameters, value, strength, focus];
        recording.run(stage, &buffers.map(Buffer::as_entire_binding), groups(size, GROUP));
    }

    /// Writes a layer of colours times opacity and opacity as RGBA with straight alpha.
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
