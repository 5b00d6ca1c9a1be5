//! Vertebrae.

use super::{ellipsoid, plate, profile, rod};
use crate::shape::Shape;
use crate::tissue::{Solid, Tissue};

#[derive(Clone, Copy)]
pub(super) struct Vertebra {
    /// Centre of the body (x is 0).
    pub(super) y: f32,
    pub(super) z: f32,
    /// Half axes of the body: lateral, anteroposterior.
    pub(super) half: [f32; 2],
    pub(super) pitch: f32,
}

const VERTEBRAL_BONE: Tissue = Tissue::Bone { cortex: 1.0, marrow: 260.0 };

pub(super) fn spine(vertebrae: &[Vertebra]) -> Vec<Solid> {
    let mut solids = Vec::new();
    let discs = vertebrae.iter().map(disc).collect();
    solids.push(Solid::new(Tissue::Mottled(85.0, 10.0), discs));
    for vertebra in vertebrae {
        let mut bone = arch(vertebra);
        bone.push(body(vertebra));
        solids.push(Solid::new(VERTEBRAL_BONE, bone));
    }
    let canal = vertebrae.iter().map(canal).collect();
    solids.push(Solid::new(Tissue::Mottled(32.0, 8.0), canal));
    solids
}

fn body(v: &Vertebra) -> Shape {
    let half = 0.385 * v.pitch;
    let [a, b] = v.half;
    profile(&[
        [v.z - half, 0.0, v.y, a, b],
        [v.z - 0.5 * half, 0.0, v.y + 0.3, 0.92 * a, 0.92 * b],
        [v.z + 0.5 * half, 0.0, v.y + 0.3, 0.92 * a, 0.92 * b],
        [v.z + half, 0.0, v.y, a, b],
    ])
}

fn disc(v: &Vertebra) -> Shape {
    let [a, b] = v.half;
    let z = v.z - 0.5 * v.pitch;
    profile(&[[z - 0.12 * v.pitch, 0.0, v.y, a, b], [z + 0.12 * v.pitch, 0.0, v.y, a, b]])
}

fn canal(v: &Vertebra) -> Shape {
    let y = v.y + v.half[1] + 0.45 * v.half[0];
    rod([0.0, y, v.z - 0.55 * v.pitch], [0.0, y, v.z + 0.55 * v.pitch], [0.38 * v.half[0]; 2])
}

fn arch(v: &Vertebra) -> Vec<Shape> {
    let (a, back) = (v.half[0], v.y + v.half[1]);
    let at = |x: f32, y: f32, z: f32| [x * a, back + y * a, v.z + z * v.pitch];
    let mut shapes = vec![plate([at(0.0, 0.95, -0.05), at(0.0, 1.75, -0.2), at(0.0, 1.7, -0.5)], 0.11 * a)];
    for side in [-1.0, 1.0] {
        shapes.extend([
            rod(at(0.62 * side, -0.2, 0.15), at(0.68 * side, 0.5, 0.1), [0.2 * a, 0.2 * a]),
            rod(at(0.68 * side, 0.5, 0.1), at(0.0, 1.05, -0.15), [0.17 * a, 0.15 * a]),
            rod(at(0.68 * side, 0.4, 0.1), at(1.75 * side, 0.65, 0.12), [0.16 * a, 0.12 * a]),
            ellipsoid(at(0.75 * side, 0.6, -0.35), [0.24 * a, 0.3 * a, 0.24 * v.pitch]),
        ]);
    }
    shapes
}
