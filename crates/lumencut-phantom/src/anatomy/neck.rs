//! Upper chest and neck of the `cervical` workload.

use super::spine::{Vertebra, spine};
use super::{Anatomy, both_sides, cervical_vessels, chain, ellipsoid, head, plate, profile, rod, torso};
use crate::shape::Shape;
use crate::tissue::{AIR, MUSCLE, Solid, Tissue};

/// The `cervical` patient, with about `segments` vessel segments.
pub(crate) fn neck(seed: u64, segments: usize) -> Anatomy {
    let mut solids = torso::table(-400.0, 400.0, 128.0).to_vec();
    solids.extend(layers());
    solids.extend(chest());
    solids.extend(soft_tissue());
    solids.extend(head::head());
    solids.extend(spine(&vertebrae()));
    solids.push(Solid::new(Tissue::Bone { cortex: 1.6, marrow: 260.0 }, shoulder_girdle()));
    solids.extend(airway());
    Anatomy { vasculature: cervical_vessels::draw(seed, segments), solids, background: AIR }
}

fn layers() -> Vec<Solid> {
    let mut skin = vec![profile(&[
        [-100.0, 0.0, 5.0, 206.0, 124.0],
        [-30.0, 0.0, 5.0, 214.0, 112.0],
        [20.0, 0.0, 8.0, 204.0, 90.0],
        [48.0, 0.0, 14.0, 150.0, 74.0],
        [72.0, 0.0, 14.0, 92.0, 67.0],
        [96.0, 0.0, 12.0, 69.0, 66.0],
        [130.0, 0.0, 10.0, 64.0, 66.0],
        [148.0, 0.0, -4.0, 63.0, 82.0],
        [164.0, 0.0, -7.0, 66.0, 90.0],
        [188.0, 0.0, 0.0, 71.0, 100.0],
        [210.0, 0.0, 6.0, 75.0, 105.0],
        [252.0, 0.0, 13.0, 79.0, 104.0],
        [292.0, 0.0, 15.0, 74.0, 92.0],
        [318.0, 0.0, 15.0, 54.0, 68.0],
        [334.0, 0.0, 15.0, 20.0, 26.0],
    ])];
    skin.push(rod([0.0, -94.0, 222.0], [0.0, -108.0, 200.0], [8.0, 13.0]));
    skin.extend(both_sides(vec![ellipsoid([78.0, 18.0, 212.0], [5.0, 17.0, 30.0])]));
    vec![
        Solid::within(&skin, 0.0, Tissue::Even(20.0)),
        Solid::within(&skin, 1.8, Tissue::Fat),
        Solid::within(&skin[..1], 8.0, Tissue::Muscle),
    ]
}

fn chest() -> Vec<Solid> {
    let lungs = both_sides(vec![ellipsoid([82.0, 6.0, -85.0], [58.0, 82.0, 122.0])]);
    let mediastinum = vec![ellipsoid([0.0, -12.0, -70.0], [40.0, 58.0, 100.0])];
    let heart = vec![ellipsoid([14.0, -44.0, -104.0], [62.0, 44.0, 46.0])];
    let pulmonary = chain(&[[12.0, -46.0, -76.0, 14.0], [16.0, -24.0, -58.0, 13.0], [48.0, 6.0, -56.0, 9.0]]);
    let veins = [
        chain(&[[-30.0, -26.0, -76.0, 9.5], [-30.0, -32.0, 4.0, 9.0], [-36.0, -26.0, 34.0, 8.0]]),
        chain(&[[-28.0, -36.0, 8.0, 7.0], [0.0, -50.0, 20.0, 7.0], [38.0, -26.0, 36.0, 7.5]]),
    ];
    vec![
        Solid::new(Tissue::Lung, lungs),
        Solid::new(Tissue::Fat, mediastinum),
        Solid::new(Tissue::Mottled(130.0, 15.0), heart),
        Solid::new(Tissue::Mottled(190.0, 10.0), pulmonary),
        Solid::new(Tissue::Mottled(140.0, 25.0), veins.concat()),
        Solid::new(Tissue::Bone { cortex: 1.3, marrow: 220.0 }, ribs()),
    ]
}

fn ribs() -> Vec<Shape> {
    let mut shapes = Vec::new();
    for n in 0u8..7 {
        let n = f32::from(n);
        let (a, b) = ((66.0 + 26.0 * n).min(147.0), (54.0 + 16.0 * n).min(93.0));
        let knot = |i: u8| {
            let turn = 0.25 + 0.26 * f32::from(i);
            let z = 48.0 - 24.0 * n - 42.0 * (0.5 * turn).sin();
            [a * turn.sin(), 6.0 + b * turn.cos(), z, 5.4]
        };
        let knots: Vec<[f32; 4]> = (0..=9).map(knot).collect();
        shapes.extend(both_sides(chain(&knots)));
    }
    shapes
}

fn soft_tissue() -> Vec<Solid> {
    let sheath =
        both_sides(chain(&[[34.0, -14.0, 56.0, 15.0], [38.0, -8.0, 120.0, 14.0], [40.0, -2.0, 190.0, 11.0]]));
    let lateral = both_sides(chain(&[[52.0, 24.0, 64.0, 15.0], [42.0, 32.0, 130.0, 7.0]]));
    let turning =
        both_sides(chain(&[[14.0, -44.0, 44.0, 7.0], [42.0, -12.0, 110.0, 9.0], [53.0, 26.0, 186.0, 9.0]]));
    let jugular =
        both_sides(chain(&[[38.0, -26.0, 36.0, 7.5], [42.0, -12.0, 90.0, 7.0], [44.0, 4.0, 192.0, 5.5]]));
    let thyroid = both_sides(vec![ellipsoid([16.0, -18.0, 88.0], [8.0, 10.0, 20.0])]);
    let parotid = both_sides(vec![ellipsoid([54.0, -4.0, 188.0], [10.0, 15.0, 19.0])]);
    let submandibular = both_sides(vec![ellipsoid([32.0, -34.0, 152.0], [10.0, 14.0, 11.0])]);
    vec![
        Solid::new(Tissue::Fat, sheath),
        Solid::new(Tissue::Fat, lateral),
        Solid::new(Tissue::Mottled(MUSCLE + 5.0, 8.0), turning),
        Solid::new(Tissue::Mottled(95.0, 15.0), jugular),
        Solid::new(Tissue::Mottled(170.0, 15.0), thyroid),
        Solid::new(Tissue::Mottled(10.0, 45.0), parotid),
        Solid::new(Tissue::Mottled(90.0, 15.0), submandibular),
    ]
}

fn airway() -> Vec<Solid> {
    let trachea = chain(&[
        [-6.0, 14.0, -40.0, 9.0],
        [-6.0, 10.0, -10.0, 9.0],
        [-2.0, -8.0, 50.0, 9.0],
        [0.0, -20.0, 100.0, 8.5],
        [0.0, -20.0, 118.0, 5.0],
        [0.0, -16.0, 130.0, 8.0],
        [0.0, -12.0, 160.0, 8.0],
        [0.0, -18.0, 190.0, 8.0],
        [0.0, -40.0, 200.0, 8.0],
    ]);
    let mut bronchi =
        chain(&[[-6.0, 14.0, -40.0, 8.0], [-34.0, 18.0, -64.0, 7.0], [-60.0, 20.0, -84.0, 6.0]]);
    bronchi.extend(chain(&[[-6.0, 14.0, -40.0, 8.0], [26.0, 14.0, -68.0, 6.5], [60.0, 20.0, -84.0, 6.0]]));
    let larynx = both_sides(vec![
        plate([[0.0, -38.0, 118.0], [16.0, -18.0, 120.0], [2.0, -36.0, 102.0]], 1.8),
        rod([0.0, -42.0, 138.0], [20.0, -20.0, 141.0], [2.6, 2.0]),
    ]);
    let oesophagus = chain(&[[4.0, 24.0, -80.0, 6.0], [3.0, 16.0, 40.0, 6.0], [0.0, 2.0, 104.0, 6.0]]);
    let tubes = [trachea, bronchi].concat();
    vec![
        Solid::new(Tissue::Even(50.0), oesophagus),
        Solid::within(&tubes, -1.6, Tissue::Even(60.0)),
        Solid::within(&tubes, 0.0, Tissue::Even(AIR)),
        Solid::new(Tissue::Bone { cortex: 1.0, marrow: 160.0 }, larynx),
    ]
}

/// T5 to C1, from below.
fn vertebrae() -> Vec<Vertebra> {
    let thoracic = (0u8..5).map(|n| {
        let n = f32::from(n);
        let y = 57.0 - 4.6 * n;
        Vertebra { y, z: -46.0 + 23.0 * n, half: [15.0 - 0.3 * n, 12.5 - 0.5 * n], pitch: 23.0 }
    });
    let cervical = (0u8..7).map(|n| {
        let n = f32::from(n);
        Vertebra { y: 34.0 - 4.0 * n + 0.35 * n * n, z: 66.0 + 18.5 * n, half: [12.0, 8.5], pitch: 18.5 }
    });
    thoracic.chain(cervical).collect()
}

fn shoulder_girdle() -> Vec<Shape> {
    let mut shapes = vec![
        plate([[-22.0, -72.0, 18.0], [22.0, -72.0, 18.0], [0.0, -84.0, -26.0]], 6.0),
        rod([0.0, -84.0, -26.0], [0.0, -98.0, -100.0], [9.0, 10.0]),
    ];
    let mut left = chain(&[
        [20.0, -68.0, 24.0, 8.0],
        [56.0, -60.0, 30.0, 6.0],
        [104.0, -32.0, 36.0, 5.5],
        [150.0, -6.0, 34.0, 6.5],
    ]);
    left.extend([
        plate([[88.0, 78.0, 4.0], [98.0, 96.0, -100.0], [160.0, 34.0, 6.0]], 2.6),
        rod([90.0, 82.0, 0.0], [158.0, 22.0, 26.0], [4.0, 7.0]),
        ellipsoid([176.0, 12.0, 2.0], [23.0, 24.0, 24.0]),
        rod([180.0, 12.0, -10.0], [186.0, 14.0, -90.0], [17.0, 12.0]),
    ]);
    shapes.extend(both_sides(left));
    shapes
}
