//! Dark lumens: negated volumes give the same lines to the bit, and airways are found, measured and not left.

use glam::DVec3;
use lumencut_core::error::Result;
use lumencut_core::polarity::Polarity;
use lumencut_core::vessel_tree::Vessel;
use lumencut_core::volume::{Volume, Voxels};
use lumencut_phantom::{Phantom, airways, y_junction};
use lumencut_vessels::kind::Kind;
use lumencut_vessels::measure::profile::measuring::measure;
use lumencut_vessels::measure::profile::request::MeasureRequest;
use lumencut_vessels::measure::wall::{WallRequest, WallSource};
use lumencut_vessels::trace::clicks::Traced;
use lumencut_vessels::trace::clicks::checks::Clicks;
use lumencut_vessels::trace::clicks::tracer::Tracer;
use lumencut_vessels::trace::find::found::Trees;
use lumencut_vessels::trace::find::{FindRequest, find_vessels, from_seed::find_from};

const REQUEST: FindRequest = FindRequest { smallest_radius: None, stop: &|| false, progress: None };

fn volume<'a>(phantom: &Phantom, voxels: &'a [i16]) -> Volume<'a> {
    let [ni, nj, _] = phantom.size;
    let strides = [1, ni, ni * nj];
    Volume::new(Voxels::I16(voxels), phantom.size, strides, phantom.world_from_index).expect("a volume")
}

/// The voxels of a phantom without values below 0, as in MR, and the same negated.
fn both(phantom: &Phantom) -> [Vec<i16>; 2] {
    let bright: Vec<i16> = phantom.voxels.iter().map(|value| value + 100).collect();
    let dark = bright.iter().map(|value| -value).collect();
    [bright, dark]
}

fn traced(volume: &Volume, vessels: &[Vec<DVec3>]) -> Result<Vec<Traced>> {
    let clicks = Clicks { vessels: vessels.to_vec(), ..Clicks::default() };
    Tracer::default().trace(volume, &clicks, &|| false, None)
}

fn airway_trees(phantom: &Phantom) -> Trees {
    let volume = phantom.volume().expect("a volume").with_polarity(Polarity::Dark);
    find_vessels(&volume, &REQUEST).expect("airways")
}

fn called<'a>(phantom: &'a Phantom, name: &str) -> &'a Vessel {
    let number = phantom.vessel_names.iter().position(|other| other == name).expect("a name");
    &phantom.tree.vessels()[number]
}

#[test]
fn a_negated_volume_gives_the_same_lines_to_the_bit() {
    let phantom = y_junction().unwrap();
    let [bright, dark] = both(&phantom);
    let (bright, dark) = (volume(&phantom, &bright), volume(&phantom, &dark).with_polarity(Polarity::Dark));
    let [one, other] = [&bright, &dark].map(|volume| find_vessels(volume, &REQUEST).unwrap());
    assert!(!one.vessels.is_empty() && one.vessels.len() == other.vessels.len());
    for (a, b) in one.vessels.iter().zip(&other.vessels) {
        assert_eq!((&a.line, a.part, a.doubt), (&b.line, b.part, b.doubt));
    }
    assert_eq!([one.level, one.contrast], [-other.level, other.contrast]);
    let points = phantom.tree.vessels()[0].points();
    let clicks = [vec![points[2], points[points.len() - 3]]];
    let [one, other] = [&bright, &dark].map(|volume| traced(volume, &clicks).unwrap());
    assert_eq!((&one[0].line, &one[0].bridged), (&other[0].line, &other[0].bridged));
}

#[test]
fn all_wide_airways_are_found_and_no_line_leaves_them_where_walls_are_thin() {
    let phantom = airways().unwrap();
    let trees = airway_trees(&phantom);
    assert_eq!(trees.kind, Kind::Airways);
    assert!((trees.level + 1000.0).abs() < 10.0, "{}", trees.level);
    let lines = || trees.vessels.iter().filter(|vessel| vessel.doubt.is_none()).map(|vessel| &vessel.line);
    let points: Vec<DVec3> = lines().flat_map(|line| line.points.clone()).collect();
    let is_near = |place: DVec3, radius: f64| points.iter().any(|point| point.distance(place) <= radius);
    let (mut wide, mut found) = (0, 0);
    for airway in phantom.tree.vessels().iter().filter(|airway| airway.radius().unwrap()[0] >= 1.5) {
        let own = airway.points();
        // Near its start an airway lies in the one before it.
        let beyond = &own[own.len() / 4..];
        let radius = airway.radius().unwrap()[0];
        let seen = beyond.iter().filter(|place| is_near(**place, radius)).count();
        wide += 1;
        found += usize::from(seen as f64 >= 0.8 * beyond.len() as f64);
    }
    assert!(wide > 50 && f64::from(found as u32) >= 0.95 * f64::from(wide), "{found} of {wide}");
    let lumens: Vec<(DVec3, f64)> = phantom
        .tree
        .vessels()
        .iter()
        .flat_map(|airway| airway.points().iter().copied().zip(airway.radius().unwrap().to_vec()))
        .collect();
    let is_outside =
        |place: &DVec3| lumens.iter().all(|(point, radius)| point.distance(*place) > radius.hypot(0.5) + 0.1);
    let outside = points.iter().filter(|place| is_outside(place)).count();
    assert!(outside as f64 <= 0.02 * points.len() as f64, "{outside} of {}", points.len());
}

#[test]
fn a_seed_in_lung_and_points_in_lung_are_refused_in_words_of_airways() {
    let phantom = airways().unwrap();
    let volume = phantom.volume().unwrap().with_polarity(Polarity::Dark);
    let end = called(&phantom, "trachea").points()[0];
    let lung = end + DVec3::new(20.0, 0.0, -10.0);
    let refused = find_from(&volume, lung, &REQUEST).unwrap_err().to_string();
    assert!(refused.contains("no airway here") && !refused.contains("vessel"), "{refused}");
    let refused = traced(&volume, &[vec![end - DVec3::Z * 5.0, lung]]).unwrap_err().to_string();
    assert!(refused.contains("tissue, such as lung") && refused.contains("darker than -"), "{refused}");
    // Bright tracing finds only the walls.
    assert!(find_vessels(&phantom.volume().unwrap(), &REQUEST).unwrap().sure_length() < 50.0);
}

#[test]
fn walls_of_airways_are_measured_with_their_thickness() {
    let phantom = airways().unwrap();
    let volume = phantom.volume().unwrap();
    for name in ["trachea", "1", "1.1", "2.2.1"] {
        let airway = called(&phantom, name);
        let radius = airway.radius().unwrap()[0];
        let whole = (0.8 + 0.15 * radius).min(1.5);
        let request = MeasureRequest {
            step: 1.0,
            fwhm: None,
            wall: WallRequest::Automatic,
            tree: &[],
            stop: &|| false,
        };
        let profile = measure(&volume, airway, &request).unwrap();
        assert_eq!(profile.polarity(), Polarity::Dark);
        assert_eq!(profile.wall_source, WallSource::Hounsfield);
        let middle = profile.arc_length.len() / 2;
        let diameter = profile.diameter_equivalent()[middle];
        assert!((diameter - 2.0 * radius).abs() < 0.05, "{name}: {diameter} of {}", 2.0 * radius);
        let wall = profile.wall[middle][0];
        assert!((wall - whole).abs() < 0.08, "{name}: a wall of {wall} instead of {whole}");
    }
}

#[test]
fn emphysema_around_an_airway_is_reported_as_a_leak_or_refused() {
    let phantom = airways().unwrap();
    // Lung as dark as lumen below the middle of the airway 1.
    let airway = called(&phantom, "1");
    let [start, end] = [airway.points()[4], airway.points()[airway.points().len() - 4]];
    let bulla = end + DVec3::new(0.0, 14.0, 0.0);
    let from_index = phantom.world_from_index;
    let mut voxels = phantom.voxels.clone();
    let [ni, nj, _] = phantom.size;
    for (n, value) in voxels.iter_mut().enumerate() {
        let index = [n % ni, n / ni % nj, n / (ni * nj)].map(|c| c as f64);
        if from_index.transform_point3(DVec3::from_array(index)).distance(bulla) < 8.0 && *value < -700 {
            *value = -990;
        }
    }
    let volume = volume(&phantom, &voxels).with_polarity(Polarity::Dark);
    match traced(&volume, &[vec![start, end, bulla]]) {
        Ok(lines) => assert!(!lines[0].bridged.is_empty()),
        Err(refused) => assert!(refused.to_string().contains("lumen"), "{refused}"),
    }
    // The search stays in the airways: no sure line ends in the bulla.
    let trees = find_from(&volume, start, &REQUEST).unwrap();
    let sure = trees.vessels.iter().filter(|vessel| vessel.doubt.is_none());
    assert!(sure.flat_map(|vessel| &vessel.line.points).all(|place| place.distance(bulla) > 8.0));
}
