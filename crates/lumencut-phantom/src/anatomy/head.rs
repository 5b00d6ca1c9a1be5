//! Skull, face and brain.

use super::{both_sides, chain, ellipsoid, plate, rod};
use crate::shape::Shape;
use crate::tissue::{AIR, FAT, Solid, Tissue};

const FACIAL_BONE: Tissue = Tissue::Bone { cortex: 1.5, marrow: 350.0 };

pub(super) fn head() -> Vec<Solid> {
    let mut solids = face();
    let skull = [ellipsoid([0.0, 16.0, 256.0], [73.0, 91.0, 73.0])];
    solids.push(Solid::within(&skull, 0.0, Tissue::Bone { cortex: 2.0, marrow: 420.0 }));
    solids.push(Solid::new(FACIAL_BONE, skull_base()));
    solids.push(Solid::within(&skull, 5.5, Tissue::Even(900.0)));
    solids.push(Solid::within(&skull, 6.5, Tissue::Even(12.0)));
    solids.extend(brain(&skull));
    solids.push(Solid::new(FACIAL_BONE, inner_base()));
    let foramen = vec![rod([0.0, 26.0, 176.0], [0.0, 24.0, 206.0], [13.0, 14.0])];
    solids.push(Solid::within(&foramen, 0.0, Tissue::Even(12.0)));
    solids.push(Solid::within(&foramen, 6.0, Tissue::Even(36.0)));
    solids.push(Solid::new(
        Tissue::Even(AIR),
        both_sides(vec![ellipsoid([52.0, 32.0, 200.0], [8.0, 9.0, 9.0])]),
    ));
    solids
}

fn brain(skull: &[Shape]) -> Vec<Solid> {
    let ventricles = both_sides(vec![
        ellipsoid([9.0, 0.0, 268.0], [5.0, 22.0, 8.0]),
        ellipsoid([22.0, 46.0, 258.0], [7.0, 16.0, 8.0]),
    ]);
    let falx = vec![plate([[0.0, -70.0, 240.0], [0.0, 100.0, 245.0], [0.0, 16.0, 330.0]], 0.8)];
    vec![
        Solid::within(skull, 8.0, Tissue::Rim { width: 4.0, rim: 42.0, core: 33.0 }),
        Solid::new(Tissue::Even(8.0), ventricles),
        Solid::new(Tissue::Even(60.0), falx),
        Solid::new(Tissue::Even(10.0), vec![ellipsoid([0.0, -18.0, 234.0], [24.0, 13.0, 8.0])]),
    ]
}

fn skull_base() -> Vec<Shape> {
    let mut shapes = both_sides(vec![
        rod([18.0, 2.0, 212.0], [62.0, 26.0, 208.0], [8.0, 12.0]),
        rod([60.0, 34.0, 206.0], [60.0, 32.0, 186.0], [11.0, 5.0]),
        plate([[14.0, -22.0, 212.0], [52.0, -30.0, 214.0], [30.0, -6.0, 208.0]], 4.0),
        plate([[22.0, 44.0, 196.0], [40.0, 76.0, 204.0], [4.0, 82.0, 206.0]], 4.0),
    ]);
    shapes.push(rod([0.0, -14.0, 222.0], [0.0, 7.0, 198.0], [9.0, 5.0]));
    shapes
}

fn inner_base() -> Vec<Shape> {
    let mut shapes = both_sides(vec![
        rod([22.0, 4.0, 214.0], [56.0, 24.0, 212.0], [6.0, 8.0]),
        plate([[16.0, -30.0, 228.0], [46.0, -40.0, 226.0], [30.0, -72.0, 236.0]], 1.4),
    ]);
    shapes.push(rod([0.0, -12.0, 218.0], [0.0, 7.0, 200.0], [8.0, 5.0]));
    shapes
}

fn face() -> Vec<Solid> {
    let orbit = both_sides(vec![ellipsoid([32.0, -64.0, 226.0], [20.0, 23.0, 19.0])]);
    let globe = both_sides(vec![ellipsoid([32.0, -73.0, 226.0], [12.0; 3])]);
    let sinus = both_sides(vec![ellipsoid([27.0, -62.0, 198.0], [14.0, 16.0, 16.0])]);
    let nose = both_sides(vec![ellipsoid([6.0, -66.0, 202.0], [4.5, 26.0, 17.0])]);
    let tongue = vec![ellipsoid([0.0, -52.0, 168.0], [26.0, 30.0, 18.0])];
    vec![
        Solid::new(Tissue::Mottled(62.0, 10.0), tongue),
        Solid::new(FACIAL_BONE, maxilla()),
        Solid::within(&sinus, -1.5, Tissue::Even(650.0)),
        Solid::within(&sinus, 0.0, Tissue::Even(AIR)),
        Solid::within(&nose, -1.2, Tissue::Even(90.0)),
        Solid::within(&nose, 0.0, Tissue::Even(AIR)),
        Solid::within(&orbit, -1.8, Tissue::Even(800.0)),
        Solid::within(&orbit, 0.0, Tissue::Even(FAT)),
        Solid::within(&globe, 0.0, Tissue::Even(65.0)),
        Solid::within(&globe, 1.8, Tissue::Even(14.0)),
        Solid::new(Tissue::Bone { cortex: 2.5, marrow: 300.0 }, mandible()),
        Solid::new(Tissue::Even(1700.0), teeth()),
    ]
}

fn maxilla() -> Vec<Shape> {
    let mut shapes = both_sides(chain(&[
        [40.0, -66.0, 204.0, 7.0],
        [58.0, -52.0, 206.0, 4.5],
        [68.0, -22.0, 208.0, 3.0],
        [68.0, 4.0, 210.0, 4.0],
    ]));
    shapes.extend(both_sides(chain(&[
        [4.0, -86.0, 184.0, 6.0],
        [18.0, -80.0, 184.0, 6.0],
        [27.0, -60.0, 184.0, 6.0],
        [29.0, -42.0, 186.0, 5.0],
    ])));
    shapes.extend(both_sides(vec![plate(
        [[0.0, -80.0, 187.0], [24.0, -56.0, 187.0], [0.0, -42.0, 187.0]],
        1.6,
    )]));
    shapes
}

fn mandible() -> Vec<Shape> {
    let mut shapes = chain(&[
        [0.0, -83.0, 158.0, 8.0],
        [18.0, -78.0, 158.0, 7.5],
        [34.0, -56.0, 158.0, 7.0],
        [46.0, -28.0, 160.0, 6.5],
        [50.0, -16.0, 172.0, 5.5],
        [53.0, -10.0, 204.0, 5.5],
    ]);
    shapes.push(plate([[47.0, -28.0, 166.0], [50.0, -14.0, 170.0], [52.0, -28.0, 198.0]], 3.0));
    both_sides(shapes)
}

fn teeth() -> Vec<Shape> {
    let mut shapes = Vec::new();
    for n in 0u8..7 {
        let turn = 0.12 + 0.2 * f32::from(n);
        let (x, y) = (29.0 * turn.sin(), -42.0 - 45.0 * turn.cos());
        let radius = 2.6 + 0.25 * f32::from(n);
        shapes.push(rod([x, y, 176.0], [x, y, 183.0], [radius, 0.6 * radius]));
        shapes.push(rod([x, y + 2.0, 163.0], [x, y + 2.0, 170.0], [0.6 * radius, radius]));
    }
    both_sides(shapes)
}
