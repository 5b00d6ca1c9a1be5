//! The picture on the GPU.

use std::sync::OnceLock;

use bytemuck::{Pod, Zeroable};
use lumencut_core::math::window::Ramp;
use lumencut_core::settings::Settings;
use wgpu::Buffer;

use crate::depth_filter::GROUP;
use crate::device::Device;
use crate::recording::Recording;
use crate::stage::Stage;
use crate::view::groups;

const ROOM: &str = "stages/composite";

/// `Paint` of `stages/composite.wgsl`.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct Paint {
    /// Where there is nothing to show.
    pub background: [f32; 4],
    /// Of the silhouettes; the last number is not used.
    pub line: [f32; 4],
    /// The values from black to white.
    pub grey: [f32; 2],
    /// The values from transparent to opaque.
    pub opacity: [f32; 2],
}

impl From<&Settings> for Paint {
    fn from(settings: &Settings) -> Self {
        let [red, green, blue] = settings.silhouette_color;
        let unit = |color: [u8; 4]| color.map(|c| f32::from(c) / 255.0);
        Self {
            background: unit(settings.background),
            line: unit([red, green, blue, 0]),
            grey: Ramp::grey(settings.window).parts(),
            opacity: Ramp::opacity(settings.opacity).parts(),
        }
    }
}

/// What a picture is made of, from the front to the back.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Layers<'a> {
    /// The volume at the cut surface, where there is one; HUGE where it shows nothing.
    pub value: Option<&'a Buffer>,
    /// Strength of the silhouettes, where they are drawn.
    pub strength: Option<&'a Buffer>,
    /// The context, colours times opacity and opacity, where there is one.
    pub context: Option<&'a Buffer>,
}

/// The layers over each other, and the context alone.
#[derive(Debug)]
pub(crate) struct Composite {
    /// With or without each layer, compiled once needed.
    stages: [OnceLock<Stage>; 8],
    layer: OnceLock<Stage>,
    paint: Buffer,
    /// Bound where a layer is not there, and never read: it is white, so that one would see it.
    nothing: Buffer,
}

impl Composite {
    pub fn new(device: &Device) -> Self {
        Self {
            stages: Default::default(),
            layer: OnceLock::new(),
            paint: device.image("paint", 1, size_of::<Paint>()),
            nothing: device.upload("nothing", &[1f32; 4]),
        }
    }

    /// Writes the picture, RGBA with straight alpha, of the layers over the background.
    pub fn record(
        &self,
        recording: &mut Recording,
        view: &Buffer,
        size: [usize; 2],
        layers: Layers,
        settings: &Settings,
        image: &Buffer,
    ) {
        let device = recording.device;
        device.write(&self.paint, &[Paint::from(settings)]);
        let Layers { value, strength, context } = layers;
        let there = [value, strength, context].map(|layer| f64::from(u8::from(layer.is_some())));
        let place = there.iter().fold(0, |place, there| 2 * place + *there as usize);
        let stage = self.stages[place].get_or_init(|| {
            let constants =
                [("ALONE", 1.0 - there[0]), ("HAS_STRENGTH", there[1]), ("HAS_CONTEXT", there[2])];
            Stage::new(device, ROOM, &constants)
        });
        let or_nothing = |layer: Option<_>| layer.unwrap_or(&self.nothing);
        let buffers =
            [view, or_nothing(context), image, &self.paint, or_nothing(value), or_nothing(strength)];
        recording.run(stage, &buffers.map(Buffer::as_entire_binding), groups(size, GROUP));
    }

    /// Writes a layer of colours times opacity and opacity as RGBA with straight alpha.
    pub fn record_layer(
        &self,
        recording: &mut Recording,
        view: &Buffer,
        size: [usize; 2],
        context: &Buffer,
        image: &Buffer,
    ) {
        let device = recording.device;
        let stage = self.layer.get_or_init(|| Stage::entry(device, ROOM, "layer", &[]));
        let buffers = [view, context, image].map(Buffer::as_entire_binding);
        recording.run(stage, &buffers, groups(size, GROUP));
    }
}
