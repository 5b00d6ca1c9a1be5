//! Airways in lung, in voxels of 0.7 mm: six generations, each of which branches into a wider and a narrower airway.

use glam::{DQuat, DVec3};
use lumencut_core::error::Result;

use crate::Phantom;
use crate::network::{KnownVessel, Vasculature};
use crate::paint::{Grid, Materials, Scene};
use crate::tissue::{AIR, VESSEL_WALL};

const SPACING: f64 = 0.7;
const MARGIN: f64 = 6.0;

/// Level of lung, and its noise (HU).
const LUNG: f32 = -850.0;
const NOISE: f32 = 15.0;

const GENERATIONS: usize = 6;

/// Radius of the first airway (mm), and the ratios of the two branches to the airway before them.
const FIRST_RADIUS: f64 = 6.0;
const RATIOS: [f64; 2] = [0.86, 0.74];

/// Length of an airway in radii, and the angles at which the two branches leave (radians).
const LENGTH: f64 = 6.0;
const ANGLES: [f64; 2] = [0.5, -0.75];

/// Angle between the planes of successive branchings (radians).
const TURN: f64 = 1.57;

/// Distance between points (mm).
const STEP: f64 = 1.0;

/// Wall thickness (mm): `WALL[0]` plus `WALL[1]` radii, at most `WALL[2]`.
const WALL: [f64; 3] = [0.8, 0.15, 1.5];

/// The airways with a thin place in their wall; the thickness there, and the length of the place (mm).
const LEAKING: [&str; 2] = ["1.2", "2.1.1"];
const THIN_WALL: f64 = 0.2;
const THIN_LENGTH: f64 = 4.0;

const MATERIALS: Materials = Materials { wall: VESSEL_WALL, plaque: VESSEL_WALL, lumen: AIR };

/// Airways of six generations in lung of −850 HU: radius 6 to 1.3 mm, wall 1 to 1.5 mm thick. The walls of the airways "1.2" and
/// "2.1.1" have a place of 4 mm where they are 0.2 mm thick.
pub fn airways() -> Result<Phantom> {
    let mut vessels = Vec::new();
    let first = Shoot { place: DVec3::ZERO, way: DVec3::NEG_Z, plane: DVec3::Y, radius: FIRST_RADIUS };
    grow(first, "trachea", 1, &mut vessels);
    let grid = Grid::around(&vessels, SPACING, MARGIN);
    let scene = Scene { background: LUNG, noise: NOISE, materials: MATERIALS, ..Scene::default() };
    Phantom::of("airways", (&grid, &scene), Vasculature { vessels, ..Vasculature::default() }, &|| false)
}

/// Where an airway begins.
#[derive(Clone, Copy)]
struct Shoot {
    place: DVec3,
    /// Direction of the airway.
    way: DVec3,
    /// Normal of the plane in which its branches leave.
    plane: DVec3,
    radius: f64,
}

fn grow(shoot: Shoot, name: &str, generation: usize, vessels: &mut Vec<KnownVessel>) {
    let length = LENGTH * shoot.radius;
    let steps = (length / STEP).ceil();
    let points: Vec<DVec3> =
        (0..=steps as usize).map(|n| shoot.place + shoot.way * (length * n as f64 / steps)).collect();
    let end = points[points.len() - 1];
    let radius = vec![shoot.radius; points.len()];
    let whole = (WALL[0] + WALL[1] * shoot.radius).min(WALL[2]);
    let is_thin = |n: usize| {
        let from_middle = length * (n as f64 / steps - 0.5);
        LEAKING.contains(&name) && from_middle.abs() <= THIN_LENGTH / 2.0
    };
    let wall = (0..points.len()).map(|n| if is_thin(n) { THIN_WALL } else { whole }).collect();
    vessels.push(KnownVessel {
        name: name.to_owned(),
        points,
        lumen: radius.clone(),
        reference: radius,
        wall,
    });
    if generation == GENERATIONS {
        return;
    }
    for (n, (ratio, angle)) in RATIOS.into_iter().zip(ANGLES).enumerate() {
        let way = DQuat::from_axis_angle(shoot.plane, angle) * shoot.way;
        let plane = DQuat::from_axis_angle(way, TURN) * shoot.plane;
        let next = Shoot { place: end, way, plane, radius: ratio * shoot.radius };
        let name = if generation == 1 { format!("{}", n + 1) } else { format!("{name}.{}", n + 1) };
        grow(next, &name, generation + 1, vessels);
    }
}
