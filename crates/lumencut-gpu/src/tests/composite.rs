//! Pictures have the same bytes as on the CPU, except that fewer than one in a thousand may differ by 1.

use lumencut_core::settings::{Context, Opacity, Settings, Window};
use lumencut_core::stages::composite::{self, CompositeParameters, layer};
use lumencut_core::stages::focus::Shares;
use lumencut_scenes::random::Random;
use lumencut_scenes::tolerances::{BYTE, OTHER_BYTE};
use lumencut_scenes::views::{front, on_cpu};

use super::{SIZES, device, finish, on_gpu, without_holes};
use crate::composite::{Composite, Layers};
use crate::device::Device;
use crate::recording::Recording;

/// Values with gaps, strengths, and a context with empty regions.
struct Scene {
    value: Vec<f32>,
    strength: Vec<f32>,
    focus: Vec<Shares>,
    rim: Vec<[u8; 4]>,
    context: Vec<[f32; 4]>,
}

impl Scene {
    fn new(pixels: usize, seed: u64) -> Self {
        let mut random = Random::new(seed);
        let hole = |random: &mut Random| random.once_in(5);
        let value = (0..pixels)
            .map(|_| if hole(&mut random) { f32::NAN } else { random.between(-1000.0, 1600.0) })
            .collect();
        let strength = (0..pixels).map(|_| random.between(-0.5, 1.0).max(0.0)).collect();
        let color = |random: &mut Random| {
            let alpha = random.between(-0.4, 1.2).clamp(0.0, 1.0);
            [0; 3].map(|_| alpha * random.between(0.0, 1.0)).map(|c| [c, alpha])
        };
        let context =
            (0..pixels).map(|_| color(&mut random)).map(|[[r, a], [g, _], [b, _]]| [r, g, b, a]).collect();
        let focus = (0..pixels).map(|_| [0; 4].map(|_| random.between(-0.5, 1.5).clamp(0.0, 1.0))).collect();
        let byte = |random: &mut Random| random.between(-100.0, 255.0).max(0.0) as u8;
        let rim = (0..pixels).map(|_| [0; 4].map(|_| byte(&mut random))).collect();
        Self { value, strength, focus, rim, context }
    }
}

#[derive(Default)]
struct Tally {
    bytes: usize,
    apart: usize,
}

impl Tally {
    fn add(&mut self, found: &[u8], expected: &[[u8; 4]], what: &str) {
        assert_eq!(found.len(), expected.as_flattened().len(), "{what}");
        for (n, (found, expected)) in found.iter().zip(expected.as_flattened()).enumerate() {
            let [a, b] = [*found, *expected].map(f32::from);
            assert!(BYTE.is_same(a, b), "{what}, byte {n}: {found}, {expected} on the CPU");
            self.apart += usize::from(!OTHER_BYTE.is_same(a, b));
        }
        self.bytes += found.len();
    }

    fn check(&self) {
        println!("{} of {} bytes are 1 apart", self.apart, self.bytes);
        assert!(self.bytes > 100_000 && OTHER_BYTE.allows(self.apart, self.bytes));
    }
}

/// Settings for every kind of opacity ramp and background.
fn settings() -> Vec<Settings> {
    let opacities = [None, Some([-200.0, 500.0]), Some([500.0, -200.0]), Some([100.0, 100.0])];
    let backgrounds = [[0, 0, 0, 255], [10, 200, 30, 101], [255, 128, 7, 0]];
    opacities
        .iter()
        .flat_map(|opacity| backgrounds.map(|background| (*opacity, background)))
        .map(|(opacity, background)| Settings {
            window: Window { level: 300.0, width: 900.0 },
            opacity: opacity.map(|[transparent, opaque]| Opacity { transparent, opaque }),
            silhouette_color: [255, 220, 3],
            background,
            context: Some(Context {
                strength: if opacity.is_some() { 0.6 } else { 1.0 },
                ..Context::default()
            }),
            ..Settings::default()
        })
        .collect()
}

/// The picture composed on the GPU; without values there is no cut surface.
fn on_the_gpu(
    device: &Device,
    composite: &Composite,
    size: [usize; 2],
    layers: &composite::Layers,
    settings: &Settings,
) -> Vec<u8> {
    let pixels = size[0] * size[1];
    let composite::Layers { value, strength, focus, rim, context } = *layers;
    let value = (!value.is_empty()).then(|| device.upload("value", &without_holes(value)));
    let strength = strength.map(|strength| device.upload("strength", strength));
    let context = context.map(|context| device.upload("context", context));
    let focus = focus.map(|focus| device.upload("focus", focus));
    let [value, strength, focus] = [&value, &strength, &focus].map(Option::as_ref);
    let rim = rim.map(|rim| device.upload("rim", rim));
    let layers = Layers { value, strength, focus, rim: rim.as_ref(), context: context.as_ref() };
    let image = device.image("image", pixels, 4);
    let mut recording = Recording::new(device);
    let view = on_gpu(device, &front(size, 0.5));
    composite.write(device, settings);
    composite.record(&mut recording, &view, size, layers, &image);
    recording.read(&image, 4 * pixels as u64);
    finish(recording).numbers(0)
}

#[test]
fn pictures_are_those_of_the_cpu() {
    let Some(device) = device() else { return };
    let composite = Composite::new(device);
    let mut tally = Tally::default();
    for size in SIZES {
        let pixels = size[0] * size[1];
        let camera = front(size, 0.5);
        let scene = Scene::new(pixels, 11);
        for settings in settings() {
            for layers in 0..16 {
                let strength = (layers & 1 != 0).then_some(&scene.strength[..]);
                let context = (layers & 2 != 0).then_some(&scene.context[..]);
                let focus = (layers & 4 != 0).then_some(&scene.focus[..]);
                let rim = (layers & 8 != 0).then_some(&scene.rim[..]);
                let mut expected = vec![[9; 4]; pixels];
                let cpu = composite::Layers { value: &scene.value, strength, focus, rim, context };
                let parameters = CompositeParameters::new(&settings);
                composite::composite(&on_cpu(&camera), &parameters, &cpu, &mut expected).unwrap();
                let found = on_the_gpu(device, &composite, size, &cpu, &settings);
                tally.add(&found, &expected, &format!("{size:?}, layers {layers}, {:?}", settings.opacity));
            }
        }
    }
    tally.check();
}

#[test]
fn a_context_alone_is_that_of_the_cpu() {
    let Some(device) = device() else { return };
    let composite = Composite::new(device);
    let mut tally = Tally::default();
    for size in SIZES {
        let pixels = size[0] * size[1];
        let camera = front(size, 0.5);
        let context = Scene::new(pixels, 12).context;
        for settings in settings() {
            let mut expected = vec![[9; 4]; pixels];
            let value = vec![f32::NAN; pixels];
            let context = Some(&context[..]);
            let cpu = composite::Layers { value: &value, strength: None, focus: None, rim: None, context };
            let parameters = CompositeParameters::new(&settings);
            composite::composite(&on_cpu(&camera), &parameters, &cpu, &mut expected).unwrap();
            let alone = composite::Layers { value: &[], ..cpu };
            let found = on_the_gpu(device, &composite, size, &alone, &settings);
            tally.add(&found, &expected, &format!("{size:?}"));
        }
    }
    tally.check();
}

#[test]
fn the_layer_is_that_of_the_cpu() {
    let Some(device) = device() else { return };
    let composite = Composite::new(device);
    let mut tally = Tally::default();
    for size in SIZES {
        let pixels = size[0] * size[1];
        let camera = front(size, 0.5);
        let context = Scene::new(pixels, 13).context;
        let mut expected = vec![[0; 4]; pixels];
        layer(&on_cpu(&camera), &context, &mut expected).unwrap();
        let (colors, image) = (device.upload("context", &context), device.image("image", pixels, 4));
        let mut recording = Recording::new(device);
        composite.record_layer(&mut recording, &on_gpu(device, &camera), size, [&colors, &image]);
        recording.read(&image, 4 * pixels as u64);
        tally.add(&finish(recording).numbers::<u8>(0), &expected, &format!("{size:?}"));
    }
    tally.check();
}

#[test]
fn halves_become_the_even_byte() {
    let Some(device) = device() else { return };
    // Opaque colours of n / 510 are n / 2 in bytes, so some lie exactly midway between two bytes.
    let context: Vec<[f32; 4]> = (0..=510).map(|n| [n as f32 / 510.0, 0.0, 0.0, 1.0]).collect();
    let camera = front([511, 1], 1.0);
    let mut expected = vec![[0; 4]; 511];
    layer(&on_cpu(&camera), &context, &mut expected).unwrap();
    let (colors, image) = (device.upload("context", &context), device.image("image", 511, 4));
    let mut recording = Recording::new(device);
    let view = on_gpu(device, &camera);
    Composite::new(device).record_layer(&mut recording, &view, [511, 1], [&colors, &image]);
    recording.read(&image, 4 * 511);
    assert_eq!(finish(recording).numbers::<u8>(0), expected.as_flattened());
    assert!(expected.iter().any(|c| c[0] % 2 == 0) && expected[1][0] == 0 && expected[3][0] == 2);
}
