//! Abdomen and pelvis: the `aorta` workload, and the upper part of `runoff`.

use super::spine::{Vertebra, spine};
use super::{Anatomy, abdominal_vessels, both_sides, chain, ellipsoid, plate, rod, torso};
use crate::network::Network;
use crate::shape::Shape;
use crate::tissue::{AIR, Solid, Tissue};

/// The `aorta` patient, with about `segments` vessel segments.
pub(crate) fn abdomen(seed: u64, segments: usize) -> Anatomy {
    let mut network = Network::new(seed);
    let external_iliac = [[50.0, 21.0, -84.0, 4.5], [62.0, 0.0, -108.0, 4.4], [68.0, -14.0, -124.0, 4.3]];
    let vessels = abdominal_vessels::draw(&mut network, 126.0, &external_iliac);
    network.stenosis(vessels.external_iliac[0], 0.5, 14.0, 65.0);

    let skin = [torso::outline()];
    let mut solids = torso::table(-400.0, 400.0, 118.0).to_vec();
    solids.extend(layers(&skin, &[]));
    solids.extend(torso::organs());
    solids.extend(bones());
    Anatomy { vasculature: network.finish(segments), solids, background: AIR }
}

pub(super) fn layers(trunk: &[Shape], legs: &[Shape]) -> Vec<Solid> {
    let all = [trunk, legs].concat();
    vec![
        Solid::within(&all, 0.0, Tissue::Even(20.0)),
        Solid::within(&all, 1.8, Tissue::Fat),
        Solid::within(trunk, 19.0, Tissue::Muscle),
        Solid::within(legs, 10.0, Tissue::Muscle),
    ]
}

pub(super) fn bones() -> Vec<Solid> {
    let mut solids = spine(&lumbar_vertebrae());
    let pelvis = Tissue::Bone { cortex: 1.6, marrow: 230.0 };
    solids.push(Solid::new(pelvis, sacrum()));
    solids.push(Solid::new(pelvis, both_sides(hip_bone())));
    solids.push(Solid::new(Tissue::Even(75.0), both_sides(vec![femoral_head(26.5)])));
    solids.push(Solid::new(Tissue::Bone { cortex: 1.5, marrow: 330.0 }, both_sides(proximal_femur())));
    solids
}

/// T10 to L5 with a slight lordosis.
fn lumbar_vertebrae() -> Vec<Vertebra> {
    let level = |n: u8| {
        let z = -30.0 + 36.0 * f32::from(n);
        let half = 23.5 - 0.6 * f32::from(n);
        Vertebra { y: 36.0 + 0.0008 * (z - 20.0).powi(2), z, half: [half, 0.72 * half], pitch: 36.0 }
    };
    (0..7).map(level).collect()
}

fn sacrum() -> Vec<Shape> {
    let mut shapes = chain(&[[0.0, 48.0, -62.0, 17.0], [0.0, 66.0, -92.0, 13.0], [0.0, 84.0, -122.0, 9.0]]);
    shapes.extend(chain(&[[0.0, 84.0, -122.0, 9.0], [0.0, 84.0, -148.0, 5.0], [0.0, 74.0, -166.0, 3.5]]));
    shapes.extend(both_sides(vec![
        plate([[10.0, 52.0, -56.0], [42.0, 66.0, -58.0], [12.0, 84.0, -118.0]], 9.0),
        plate([[0.0, 78.0, -60.0], [0.0, 86.0, -80.0], [20.0, 78.0, -70.0]], 5.0),
    ]));
    shapes
}

fn hip_bone() -> Vec<Shape> {
    let (joint, back) = ([55.0, 74.0, -66.0], [62.0, 84.0, -28.0]);
    let (crest, spine) = ([104.0, 38.0, 2.0], [122.0, -30.0, -44.0]);
    let fossa = [99.0, 30.0, -50.0];
    let (notch, roof) = ([62.0, 56.0, -100.0], [90.0, 6.0, -122.0]);
    let mut shapes = vec![
        plate([joint, back, crest], 5.5),
        plate([joint, crest, fossa], 3.4),
        plate([crest, spine, fossa], 3.4),
        plate([spine, roof, fossa], 3.8),
        plate([roof, joint, fossa], 3.8),
        plate([joint, notch, roof], 6.5),
        rod(back, crest, [7.0, 7.0]),
        rod(crest, spine, [7.5, 6.5]),
        ellipsoid([84.0, 8.0, -143.0], [31.0, 31.0, 31.0]),
    ];
    // Pubis and ischium around the obturator foramen.
    shapes.extend(chain(&[
        [68.0, -12.0, -146.0, 9.0],
        [36.0, -38.0, -158.0, 7.0],
        [11.0, -46.0, -170.0, 9.0],
        [13.0, -40.0, -188.0, 7.5],
        [40.0, 2.0, -212.0, 6.5],
        [60.0, 32.0, -214.0, 12.0],
        [78.0, 30.0, -165.0, 15.0],
    ]));
    shapes
}

fn femoral_head(radius: f32) -> Shape {
    ellipsoid([91.0, 6.0, -150.0], [radius; 3])
}

fn proximal_femur() -> Vec<Shape> {
    vec![
        femoral_head(24.0),
        rod([91.0, 6.0, -150.0], [122.0, 10.0, -180.0], [16.0, 17.0]),
        ellipsoid([136.0, 16.0, -172.0], [14.0, 19.0, 22.0]),
        rod([122.0, 10.0, -180.0], [120.0, 10.0, -245.0], [18.0, 14.0]),
        ellipsoid([108.0, 20.0, -206.0], [10.0, 11.0, 13.0]),
    ]
}
