use std::collections::BTreeSet;

use glam::{DAffine3, DVec3};
use lumencut_core::vessel_tree::{Vessel, VesselTree};
use lumencut_core::volume::{Volume, Voxels};
use lumencut_phantom::{Phantom, aorta, cervical, runoff};

use super::{NamedStretch, SuggestedName, is_nameless, suggested_names};
use crate::vessel_names::vessel_named;

type Suggested = Vec<SuggestedName>;

fn suggested(tree: &VesselTree) -> Suggested {
    let lines: Vec<_> = tree.vessels().iter().map(|vessel| (vessel.points(), vessel.radius())).collect();
    suggested_names(&lines, None)
}

/// A name without its number, so that both spellings of a vessel are equal. All parts of the aorta are the aorta.
fn meant(name: &str) -> Option<String> {
    let (vessel, side) = vessel_named(name)?;
    let name = if vessel.name.contains("aort") { "aorta" } else { vessel.name };
    Some(format!("{name} {side:?}"))
}

/// The name of a stretch of a line: lines of phantoms run on where arteries only change their names.
fn truth_at(line: &str, stretch: &NamedStretch, length: &f64) -> String {
    let runs_on = [("external iliac", "common femoral", 60.0), ("superficial femoral", "popliteal", 160.0)];
    let [from, to] = stretch.range;
    for (before, after, last) in runs_on {
        if line.contains(before) && length - from <= last && length - to < 12.5 {
            return line.replace(before, after);
        }
    }
    line.to_owned()
}

/// Checks every suggestion against the names of the phantom, and returns the names.
fn checked(phantom: &Phantom) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    let lengths = phantom.tree.vessels().iter().map(|vessel| *vessel.arc_length().last().unwrap());
    let all = suggested(&phantom.tree).into_iter().zip(lengths);
    for (suggested, truth) in all.zip(&phantom.vessel_names) {
        for stretch in &suggested.0.stretches {
            assert!(meant(&stretch.name).is_some(), "{} stands in the table", stretch.name);
            let truth = truth_at(truth, stretch, &suggested.1);
            assert_eq!(meant(&stretch.name), meant(&truth), "{}: {truth}", phantom.name);
            names.insert(stretch.name.clone());
        }
    }
    names
}

const ABDOMEN: [&str; 14] = [
    "Abdominal aorta",
    "Celiac trunk",
    "Common hepatic artery",
    "Inferior mesenteric artery",
    "Left common iliac artery",
    "Left external iliac artery",
    "Left internal iliac artery",
    "Left renal artery",
    "Right common iliac artery",
    "Right external iliac artery",
    "Right internal iliac artery",
    "Right renal artery",
    "Splenic artery",
    "Superior mesenteric artery",
];

const LEGS: [&str; 14] = [
    "Left anterior tibial artery",
    "Left common femoral artery",
    "Left deep femoral artery",
    "Left fibular artery",
    "Left popliteal artery",
    "Left posterior tibial artery",
    "Left superficial femoral artery",
    "Right anterior tibial artery",
    "Right common femoral artery",
    "Right deep femoral artery",
    "Right fibular artery",
    "Right popliteal artery",
    "Right posterior tibial artery",
    "Right superficial femoral artery",
];

const OF_LEGS: [&str; 8] =
    ["femoral", "circumflex", "perforating", "geniculate", "sural", "tibi", "peroneal", "epigastric"];

const NECK: [&str; 12] = [
    "Aorta",
    "Brachiocephalic trunk",
    "Left common carotid artery",
    "Left external carotid artery",
    "Left internal carotid artery",
    "Left subclavian artery",
    "Left vertebral artery",
    "Right common carotid artery",
    "Right external carotid artery",
    "Right internal carotid artery",
    "Right subclavian artery",
    "Right vertebral artery",
];

#[test]
fn no_vessel_of_a_phantom_gets_the_name_of_another() {
    for seed in 0..4 {
        let expected = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect::<BTreeSet<_>>();
        assert_eq!(checked(&aorta(seed, 0.02).unwrap()), expected(&ABDOMEN), "seed {seed}");
        let both: Vec<&str> = ABDOMEN.into_iter().chain(LEGS).collect();
        assert_eq!(checked(&runoff(seed, 0.02).unwrap()), expected(&both), "seed {seed}");
        assert_eq!(checked(&cervical(seed, 0.02).unwrap()), expected(&NECK), "seed {seed}");
    }
}

/// Vessels that a search misses must not give their names to others.
#[test]
fn legs_without_some_of_their_vessels_have_no_wrong_names() {
    let phantom = runoff(0, 0.02).unwrap();
    let (mut state, mut named) = (1_u64, 0);
    for _ in 0..60 {
        let mut is_kept = |(_, name): &(_, &String)| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            !OF_LEGS.iter().any(|part| name.contains(part)) || (state >> 33) % 10 >= 2
        };
        let all = phantom.tree.vessels().iter().zip(&phantom.vessel_names);
        let (kept, names): (Vec<_>, Vec<_>) =
            all.filter(&mut is_kept).map(|(vessel, name)| (vessel.clone(), name)).unzip();
        let tree = VesselTree::new(kept).unwrap();
        for ((vessel, found), truth) in tree.vessels().iter().zip(suggested(&tree)).zip(names) {
            for stretch in found.stretches.iter().filter(|stretch| LEGS.contains(&&*stretch.name)) {
                let truth = truth_at(truth, stretch, vessel.arc_length().last().unwrap());
                assert_eq!(meant(&stretch.name), meant(&truth), "{truth}");
                named += 1;
            }
        }
    }
    assert!(named > 100, "{named} names");
}

/// The tree with each point moved.
fn moved(tree: &VesselTree, place: impl Fn(DVec3) -> DVec3) -> VesselTree {
    let vessel = |vessel: &Vessel| {
        let points = vessel.points().iter().map(|point| place(*point)).collect();
        Vessel::new(points, vessel.radius().map(<[f64]>::to_vec)).unwrap()
    };
    VesselTree::new(tree.vessels().iter().map(vessel).collect()).unwrap()
}

#[test]
fn a_mirrored_body_has_the_other_sides_and_one_upside_down_has_no_names() {
    let phantom = aorta(0, 0.02).unwrap();
    let mirrored = suggested(&moved(&phantom.tree, |point| point * DVec3::new(-1.0, 1.0, 1.0)));
    let sides = [("Left renal", "right renal artery"), ("Right common iliac", "left common iliac artery")];
    for (side, truth) in sides {
        let number = phantom.vessel_names.iter().position(|name| name == truth).unwrap();
        assert!(mirrored[number].name.as_ref().unwrap().starts_with(side));
    }
    for axis in [DVec3::new(1.0, -1.0, -1.0), DVec3::new(-1.0, 1.0, -1.0)] {
        let turned = suggested(&moved(&phantom.tree, |point| point * axis));
        assert!(turned.iter().all(|line| line.name.is_none() && line.stretches.is_empty()));
    }
}

#[test]
fn the_inferior_vena_cava_is_no_aorta() {
    // Without anterior branches and with one renal vessel only, the tree may be that of veins.
    let phantom = aorta(0, 0.02).unwrap();
    let is_kept =
        |name: &str| ["abdominal aorta", "iliac", "left renal"].iter().any(|part| name.contains(part));
    let kept = phantom.tree.vessels().iter().zip(&phantom.vessel_names).filter(|(_, name)| is_kept(name));
    let veins = VesselTree::new(kept.map(|(vessel, _)| vessel.clone()).collect()).unwrap();
    assert!(suggested(&veins).iter().all(|line| line.name.is_none()));
}

#[test]
fn a_line_that_runs_on_has_both_names_and_a_line_without_radii_none() {
    let phantom = aorta(0, 0.02).unwrap();
    let of = |name: &str| {
        let number = phantom.vessel_names.iter().position(|known| known == name).unwrap();
        phantom.tree.vessels()[number].clone()
    };
    let [celiac, hepatic] = [of("coeliac trunk"), of("common hepatic artery 1")];
    let mut points = celiac.points().to_vec();
    points.extend(&hepatic.points()[1..]);
    let mut radius = celiac.radius().unwrap().to_vec();
    radius.extend(&hepatic.radius().unwrap()[1..]);
    let others = phantom.tree.vessels().iter().filter(|vessel| **vessel != celiac && **vessel != hepatic);
    let mut lines: Vec<_> = others.map(|vessel| (vessel.points(), vessel.radius())).collect();
    lines.push((&points, Some(&radius)));
    let named = suggested_names(&lines, None).pop().unwrap();
    assert_eq!(named.name.as_deref(), Some("Celiac trunk to common hepatic artery"));
    let [first, second] = &named.stretches[..] else { panic!("two stretches") };
    assert_eq!((first.range[0], first.range[1]), (0.0, second.range[0]));
    lines.pop();
    lines.push((&points, None));
    assert_eq!(suggested_names(&lines, None).pop().unwrap(), SuggestedName::default());
    assert!(suggested_names(&[], None).is_empty());
}

#[test]
fn vessels_brighter_than_the_aorta_and_pale_ones_away_from_it_are_veins_or_heart() {
    let phantom = aorta(0, 0.02).unwrap();
    let beside = |x: f64| (0..60).map(|n| DVec3::new(x, 0.0, 2.0 * f64::from(n) - 20.0)).collect::<Vec<_>>();
    let tubes = [150.0, 170.0, 190.0, 210.0].map(beside);
    let radius = vec![5.0; 60];
    let mut lines: Vec<_> =
        phantom.tree.vessels().iter().map(|vessel| (vessel.points(), vessel.radius())).collect();
    lines.extend(tubes.iter().map(|points| (&points[..], Some(&radius[..]))));
    // Arteries at 300 above 0; the four tubes at 400, 300, 180 and 90.
    let size = [90, 60, 70];
    let origin = DVec3::new(-120.0, -120.0, -130.0);
    let mut voxels = vec![0.0_f32; size.iter().product()];
    let mut paint = |points: &[DVec3], value: f32| {
        for point in points {
            let [i, j, k] = ((*point - origin) / 4.0).floor().to_array().map(|index| index as usize);
            for corner in 0..8 {
                let [i, j, k] = [i + corner % 2, j + corner / 2 % 2, k + corner / 4];
                voxels[(k * size[1] + j) * size[0] + i] = value;
            }
        }
    };
    phantom.tree.vessels().iter().for_each(|vessel| paint(vessel.points(), 300.0));
    [400.0, 300.0, 180.0, 90.0].into_iter().zip(&tubes).for_each(|(value, tube)| paint(tube, value));
    let world = DAffine3::from_scale_rotation_translation(DVec3::splat(4.0), glam::DQuat::IDENTITY, origin);
    let volume = Volume::new(Voxels::F32(&voxels), size, [1, size[0], size[0] * size[1]], world).unwrap();
    let found = suggested_names(&lines, Some(&volume));
    let veins: Vec<bool> = found.iter().map(|line| line.is_vein_or_heart).collect();
    let (arteries, tubes) = veins.split_at(phantom.tree.vessels().len());
    assert!(arteries.iter().all(|is_vein| !is_vein));
    assert_eq!(tubes, [true, false, true, false]);
    // Without the scan, nothing is known of brightness.
    assert!(suggested_names(&lines, None).iter().all(|line| !line.is_vein_or_heart));
}

#[test]
fn only_vessels_that_a_reader_has_not_named_are_offered_a_name() {
    for name in ["", "Vessel 3", "Branch 12", "LAD 2"] {
        assert!(is_nameless(name), "{name}");
    }
    for name in ["LAD", "Aorta", "graft"] {
        assert!(!is_nameless(name), "{name}");
    }
}
