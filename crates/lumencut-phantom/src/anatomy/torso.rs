//! Soft tissue and ribs of abdomen and pelvis.

use super::{both_sides, chain, ellipsoid, plate, profile, rod};
use crate::shape::Shape;
use crate::tissue::{AIR, FAT, MUSCLE, Solid, Tissue};

pub(super) fn outline() -> Shape {
    profile(&[
        [-262.0, 0.0, 12.0, 40.0, 12.0],
        [-238.0, 0.0, 10.0, 150.0, 66.0],
        [-200.0, 0.0, 9.0, 178.0, 94.0],
        [-150.0, 0.0, 8.0, 178.0, 102.0],
        [-80.0, 0.0, 6.0, 168.0, 104.0],
        [0.0, 0.0, 8.0, 152.0, 103.0],
        [80.0, 0.0, 6.0, 156.0, 108.0],
        [150.0, 0.0, 5.0, 162.0, 112.0],
        [230.0, 0.0, 5.0, 166.0, 116.0],
    ])
}

fn cavity() -> Shape {
    profile(&[
        [-186.0, 0.0, -8.0, 8.0, 6.0],
        [-170.0, 0.0, -8.0, 46.0, 34.0],
        [-130.0, 0.0, -2.0, 82.0, 56.0],
        [-80.0, 0.0, -3.0, 102.0, 64.0],
        [0.0, 0.0, -4.0, 116.0, 68.0],
        [100.0, 0.0, -4.0, 126.0, 78.0],
        [230.0, 0.0, 0.0, 132.0, 86.0],
    ])
}

fn peritoneum() -> Shape {
    profile(&[
        [-118.0, 0.0, -30.0, 56.0, 20.0],
        [-90.0, 0.0, -34.0, 88.0, 30.0],
        [0.0, 0.0, -37.0, 104.0, 33.0],
        [80.0, 0.0, -43.0, 104.0, 33.0],
        [112.0, 0.0, -46.0, 70.0, 24.0],
    ])
}

pub(super) fn organs() -> Vec<Solid> {
    let mut solids = vec![Solid::new(Tissue::Fat, vec![cavity()])];
    solids.push(Solid::new(Tissue::Muscle, psoas()));
    solids.push(Solid::new(Tissue::Bowel, vec![peritoneum()]));
    solids.push(Solid::new(Tissue::Bowel, colon()));
    solids.extend(upper_organs());
    solids.extend(kidneys());
    solids.extend(veins());
    let bladder = vec![ellipsoid([0.0, -18.0, -138.0], [42.0, 32.0, 30.0])];
    solids.push(Solid::within(&bladder, 0.0, Tissue::Even(MUSCLE - 10.0)));
    solids.push(Solid::within(&bladder, 3.5, Tissue::Even(8.0)));
    solids.push(Solid::new(Tissue::Bone { cortex: 1.4, marrow: 180.0 }, ribs()));
    solids
}

fn psoas() -> Vec<Shape> {
    both_sides(chain(&[
        [27.0, 40.0, 92.0, 8.0],
        [34.0, 40.0, 40.0, 15.0],
        [46.0, 36.0, -25.0, 20.0],
        [66.0, 2.0, -100.0, 19.0],
        [88.0, -14.0, -150.0, 15.0],
        [98.0, 6.0, -200.0, 10.0],
    ]))
}

fn colon() -> Vec<Shape> {
    both_sides(chain(&[[96.0, 2.0, -70.0, 19.0], [98.0, 16.0, 0.0, 17.0], [98.0, 10.0, 60.0, 18.0]]))
}

fn upper_organs() -> Vec<Solid> {
    let liver = vec![
        ellipsoid([-62.0, -2.0, 150.0], [60.0, 66.0, 66.0]),
        ellipsoid([-10.0, -38.0, 160.0], [62.0, 30.0, 40.0]),
    ];
    let spleen = vec![ellipsoid([98.0, 34.0, 130.0], [24.0, 36.0, 44.0])];
    let stomach = vec![ellipsoid([52.0, -30.0, 140.0], [38.0, 32.0, 42.0])];
    let gas = vec![ellipsoid([50.0, -44.0, 142.0], [26.0, 12.0, 30.0])];
    let pancreas = chain(&[[-32.0, -14.0, 82.0, 13.0], [0.0, -20.0, 94.0, 9.0], [60.0, 6.0, 100.0, 9.0]]);
    vec![
        Solid::new(Tissue::Mottled(92.0, 12.0), pancreas),
        Solid::new(Tissue::Mottled(80.0, 9.0), liver),
        Solid::new(Tissue::Mottled(125.0, 25.0), spleen),
        Solid::within(&stomach, 0.0, Tissue::Even(75.0)),
        Solid::within(&stomach, 4.0, Tissue::Mottled(20.0, 25.0)),
        Solid::new(Tissue::Even(AIR), gas),
    ]
}

fn kidneys() -> [Solid; 2] {
    let kidneys = vec![
        ellipsoid([86.0, 38.0, 80.0], [25.0, 27.0, 50.0]),
        ellipsoid([-86.0, 38.0, 66.0], [25.0, 27.0, 50.0]),
    ];
    let sinus = vec![
        ellipsoid([74.0, 34.0, 80.0], [13.0, 8.0, 20.0]),
        ellipsoid([-74.0, 34.0, 66.0], [13.0, 8.0, 20.0]),
    ];
    let kidney = Tissue::Rim { width: 7.0, rim: 215.0, core: 120.0 };
    [Solid::new(kidney, kidneys), Solid::new(Tissue::Mottled(FAT + 15.0, 30.0), sinus)]
}

fn veins() -> [Solid; 1] {
    let mut veins = chain(&[
        [-16.0, 14.0, -12.0, 9.0],
        [-22.0, 4.0, 20.0, 10.5],
        [-23.0, 2.0, 90.0, 11.0],
        [-26.0, 4.0, 210.0, 13.0],
    ]);
    veins.extend(both_sides(chain(&[
        [16.0, 17.0, -14.0, 7.0],
        [34.0, 36.0, -52.0, 6.5],
        [46.0, 28.0, -88.0, 6.0],
        [60.0, -14.0, -135.0, 6.0],
    ])));
    [Solid::new(Tissue::Mottled(115.0, 12.0), veins)]
}

fn ribs() -> Vec<Shape> {
    let mut shapes = Vec::new();
    for (n, last) in [(0u8, 5usize), (1, 7), (2, 9), (3, 9), (4, 9), (5, 9)] {
        let top = 92.0 + 30.0 * f32::from(n);
        let knot = |i: usize| {
            // A rib starts 0.2 rad from the midline of the back and runs around to the front.
            let turn = 0.2 + 0.27 * i as f32;
            let knot = [136.0 * turn.sin(), 3.0 + 89.0 * turn.cos(), top - 62.0 * (0.6 * turn).sin()];
            [knot[0], knot[1], knot[2], 5.2]
        };
        let knots: Vec<[f32; 4]> = (0..=last).map(knot).collect();
        shapes.extend(both_sides(chain(&knots)));
    }
    shapes
}

/// Mattress and table below the patient, from z = `low` to `high`.
pub(super) fn table(low: f32, high: f32, y: f32) -> [Solid; 2] {
    let slab = |depth: f32| -> Vec<Shape> {
        let strip = |n: i16| {
            // The table is slightly hollow, like the tables of CT scanners.
            let edge = |n: i16| {
                let x = 40.0 * f32::from(n);
                (x, y + depth - 0.00035 * x * x)
            };
            let ((x0, y0), (x1, y1)) = (edge(n), edge(n + 1));
            [
                plate([[x0, y0, low], [x1, y1, low], [x0, y0, high]], 1.2),
                plate([[x1, y1, low], [x1, y1, high], [x0, y0, high]], 1.2),
            ]
        };
        (-5..5).flat_map(strip).collect()
    };
    let shell = slab(9.0);
    let mattress = slab(4.0);
    [Solid::within(&mattress, -2.5, Tissue::Mottled(-930.0, 20.0)), Solid::new(Tissue::Even(-120.0), shell)]
}

pub(super) fn femoral_veins() -> Solid {
    let mut veins = Vec::new();
    for side in [-1.0, 1.0] {
        let at = |x: f32, y: f32, z: f32| [side * x, y, z];
        veins.push(rod(at(60.0, -14.0, -135.0), at(63.0, -36.0, -190.0), [6.0, 6.0]));
        veins.push(rod(at(63.0, -36.0, -190.0), at(57.0, -22.0, -330.0), [5.5, 5.0]));
        veins.push(rod(at(57.0, -22.0, -330.0), at(76.0, 38.0, -545.0), [5.0, 4.5]));
    }
    Solid::new(Tissue::Mottled(70.0, 8.0), veins)
}
