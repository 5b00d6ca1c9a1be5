//! Both legs: the `runoff` workload below the abdomen.

use super::{
    Anatomy, abdomen, abdominal_vessels, both_sides, chain, ellipsoid, leg_vessels, profile, rod, torso,
};
use crate::network::Network;
use crate::shape::Shape;
use crate::tissue::{AIR, Solid, Tissue};

/// The `runoff` patient, with about `segments` vessel segments.
pub(crate) fn lower_extremities(seed: u64, segments: usize) -> Anatomy {
    let mut network = Network::new(seed);
    let vessels = abdominal_vessels::draw(&mut network, 169.0, &leg_vessels::EXTERNAL_ILIAC);
    // The bypass circumvents this stenosis.
    network.stenosis(vessels.external_iliac[1], 0.3, 30.0, 92.0);
    leg_vessels::draw(&mut network, vessels.external_iliac);

    let mut solids = torso::table(-1500.0, 400.0, 118.0).to_vec();
    solids.extend(abdomen::layers(&[torso::outline()], &both_sides(vec![leg()])));
    solids.push(Solid::within(&both_sides(foot()), 0.0, Tissue::Even(30.0)));
    solids.push(Solid::within(&both_sides(foot()), 3.5, Tissue::Muscle));
    solids.extend(torso::organs());
    solids.push(torso::femoral_veins());
    solids.extend(abdomen::bones());
    solids.extend(leg_bones());
    Anatomy { vasculature: network.finish(segments), solids, background: AIR }
}

fn leg() -> Shape {
    profile(&[
        [-1060.0, 82.0, 14.0, 32.0, 38.0],
        [-1010.0, 82.0, 12.0, 33.0, 37.0],
        [-930.0, 84.0, 15.0, 37.0, 42.0],
        [-800.0, 87.0, 20.0, 51.0, 56.0],
        [-710.0, 90.0, 20.0, 57.0, 61.0],
        [-640.0, 90.0, 12.0, 54.0, 58.0],
        [-580.0, 88.0, 4.0, 56.0, 60.0],
        [-500.0, 88.0, 2.0, 64.0, 67.0],
        [-380.0, 90.0, 4.0, 76.0, 77.0],
        [-280.0, 93.0, 8.0, 84.0, 83.0],
        [-210.0, 93.0, 9.0, 85.0, 86.0],
        [-160.0, 90.0, 8.0, 82.0, 86.0],
    ])
}

/// The left foot of a supine patient, pointing up and slightly forward.
fn foot() -> Vec<Shape> {
    let mut shapes = chain(&[
        [82.0, 34.0, -1082.0, 25.0],
        [82.0, 0.0, -1072.0, 31.0],
        [82.0, -50.0, -1076.0, 29.0],
        [82.0, -100.0, -1092.0, 22.0],
    ]);
    shapes.push(ellipsoid([82.0, -100.0, -1096.0], [38.0, 34.0, 16.0]));
    shapes
}

fn leg_bones() -> Vec<Solid> {
    let joint = Tissue::Bone { cortex: 1.3, marrow: 250.0 };
    let shaft = Tissue::Bone { cortex: 5.0, marrow: -40.0 };
    let fibula = chain(&[
        [114.0, 20.0, -650.0, 9.0],
        [110.0, 22.0, -690.0, 6.0],
        [106.0, 22.0, -950.0, 6.5],
        [106.0, 20.0, -1030.0, 9.0],
    ]);
    let patella = vec![ellipsoid([88.0, -42.0, -582.0], [22.0, 10.0, 23.0])];
    vec![
        Solid::new(shaft, both_sides(femoral_shaft())),
        Solid::new(joint, both_sides(distal_femur())),
        Solid::new(joint, both_sides(patella)),
        Solid::new(shaft, both_sides(tibial_shaft())),
        Solid::new(joint, both_sides(tibial_ends())),
        Solid::new(Tissue::Bone { cortex: 2.5, marrow: 100.0 }, both_sides(fibula)),
        Solid::new(joint, both_sides(foot_bones())),
    ]
}

fn femoral_shaft() -> Vec<Shape> {
    chain(&[
        [120.0, 10.0, -235.0, 15.0],
        [112.0, 0.0, -330.0, 14.0],
        [100.0, -4.0, -450.0, 14.5],
        [92.0, 2.0, -540.0, 18.0],
    ])
}

fn distal_femur() -> Vec<Shape> {
    vec![
        rod([92.0, 2.0, -535.0], [89.0, 4.0, -575.0], [18.5, 26.0]),
        ellipsoid([70.0, 10.0, -590.0], [19.0, 30.0, 24.0]),
        ellipsoid([108.0, 10.0, -590.0], [19.0, 30.0, 24.0]),
        ellipsoid([89.0, -8.0, -585.0], [30.0, 20.0, 20.0]),
    ]
}

fn tibial_shaft() -> Vec<Shape> {
    chain(&[
        [88.0, 4.0, -665.0, 20.0],
        [84.0, -2.0, -740.0, 15.0],
        [81.0, 0.0, -880.0, 13.0],
        [82.0, 6.0, -1000.0, 15.0],
    ])
}

fn tibial_ends() -> Vec<Shape> {
    vec![
        ellipsoid([89.0, 8.0, -634.0], [41.0, 27.0, 17.0]),
        rod([89.0, 6.0, -640.0], [88.0, 4.0, -672.0], [26.0, 20.0]),
        ellipsoid([89.0, -16.0, -660.0], [10.0, 11.0, 16.0]),
        rod([82.0, 6.0, -995.0], [82.0, 8.0, -1024.0], [15.5, 20.0]),
        ellipsoid([65.0, 6.0, -1034.0], [7.0, 11.0, 14.0]),
    ]
}

fn foot_bones() -> Vec<Shape> {
    let mut shapes = vec![
        ellipsoid([82.0, 4.0, -1052.0], [17.0, 26.0, 12.0]),
        ellipsoid([84.0, 30.0, -1080.0], [15.0, 24.0, 18.0]),
        ellipsoid([74.0, -24.0, -1062.0], [13.0, 11.0, 12.0]),
        ellipsoid([96.0, -20.0, -1076.0], [11.0, 14.0, 11.0]),
    ];
    for ray in 0u8..5 {
        let n = f32::from(ray);
        let x = 58.0 + 12.0 * n;
        let knee = [x, -92.0 + 4.0 * n, -1096.0, 5.5];
        let tip = [x, -116.0 + 7.0 * n, -1100.0, 4.0];
        shapes.extend(chain(&[[66.0 + 8.0 * n, -38.0, -1074.0, 6.5], knee, tip]));
    }
    shapes
}
