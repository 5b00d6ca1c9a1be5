//! Tests that profiles are stored as numbers and restored.

use lumencut_core::volume::{Volume, Voxels};
use lumencut_phantom::Phantom;
use lumencut_vessels::measure::measuring::measure;
use lumencut_vessels::measure::request::MeasureRequest;
use lumencut_vessels::measure::wall_level::WallRequest;

use super::*;

fn profile(wall: WallRequest) -> Profile {
    let Phantom { voxels, size, world_from_index, tree, .. } =
        lumencut_phantom::y_junction().expect("a phantom");
    let strides = [1, size[0], size[0] * size[1]];
    let volume = Volume::new(Voxels::I16(&voxels), size, strides, world_from_index).expect("a volume");
    let request = MeasureRequest { step: 1.0, fwhm: None, wall, tree: tree.vessels(), stop: &|| false };
    measure(&volume, &tree.vessels()[1], &request).expect("a profile")
}

fn all_of(profile: &Profile) -> String {
    format!("{profile:?}")
}

#[test]
fn a_stored_profile_is_the_same_to_the_bit() {
    for wall in [WallRequest::Automatic, WallRequest::Off, WallRequest::Level([30.0, 20.0])] {
        let profile = profile(wall);
        let stored = StoredProfile::of(&profile);
        let again = stored.profile().expect("the same profile");
        assert_eq!(all_of(&again), all_of(&profile));
        assert!(again.contour.iter().any(|points| !points.is_empty()));
    }
}

#[test]
fn every_source_is_stored() {
    let pooled = |given| {
        let by_others = PooledWall { level: [40.0, 12.5], vessels: 3 };
        WallSource::Pooled { given, by_others }
    };
    let walls = [
        WallSource::Hounsfield,
        WallSource::Given([45.0, 25.0]),
        pooled(None),
        pooled(Some([30.0, 10.0])),
        WallSource::NotAsked,
        WallSource::DarkLumen,
        WallSource::OtherUnit,
        WallSource::AsBright,
    ];
    for wall in walls {
        assert_eq!(restored_wall(&stored_wall(&wall)).expect("a wall"), wall);
    }
    let on = "16 wide sections".to_owned();
    for source in [Source::Given, Source::Estimated { on: on.clone() }, Source::Assumed { from: on }] {
        assert_eq!(restored_source(&stored_source(&source)).expect("a source"), source);
    }
}

#[test]
fn what_is_damaged_is_refused_by_name() {
    let whole = StoredProfile::of(&profile(WallRequest::Off));
    let column = |name: &str| whole.columns.iter().position(|(other, _)| other == name).expect("a column");
    let mut cases = Vec::new();
    for (name, change) in [
        ("area", Box::new(|numbers: &mut Vec<f64>| numbers.push(1.0)) as Box<dyn Fn(&mut Vec<f64>)>),
        ("axes", Box::new(|numbers: &mut Vec<f64>| numbers.truncate(5))),
        ("contour", Box::new(|numbers: &mut Vec<f64>| numbers[0] = 1e6)),
        ("contour", Box::new(|numbers: &mut Vec<f64>| numbers[0] = f64::NAN)),
        ("noise", Box::new(Vec::clear)),
    ] {
        let mut damaged = whole.clone();
        change(&mut damaged.columns[column(name)].1);
        cases.push(damaged);
    }
    let mut without = whole.clone();
    without.columns.remove(column("levels"));
    let mut flags = whole.clone();
    flags.flags.pop();
    let mut wall = whole.clone();
    wall.wall_source = ("hounsfield".to_owned(), vec![1.0]);
    let mut spread = whole;
    spread.fwhm_source.0 = "guessed".to_owned();
    cases.extend([without, flags, wall, spread]);
    for damaged in cases {
        let error = damaged.profile().expect_err("it is damaged");
        assert_eq!((error.kind, error.subject.as_str()), (ErrorKind::Measuring, "stored profile"));
    }
}
