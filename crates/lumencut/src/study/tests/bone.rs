use lumencut_core::progress::Progress;
use lumencut_phantom::Phantom;
use lumencut_vessels::trace::find::bone_voxels::for_each_voxel;

use super::*;
use crate::study::lines::Line;
use crate::study::voxels::Stored;

/// Values of compact bone (HU) in the phantom, where only bone and plaque are that bright.
const COMPACT: i16 = 650;

fn opened() -> Study {
    let Phantom { voxels, size, world_from_index, tree, vessel_names, .. } =
        lumencut_phantom::aorta(0, 0.4).expect("a phantom");
    let (stored, scan) = (Stored::I16(voxels), Default::default());
    let held = HeldVolume { stored, size, world_from_index, key: Default::default(), scan };
    let mut study = Study::default();
    study.open(held, tree, vessel_names).expect("a tree");
    study
}

fn listed(study: &Study) -> Vec<ListedLine> {
    let named = study.content.named.as_ref().expect("vessels");
    let of =
        |line: &usize| ListedLine { line: *line, name: String::new(), hidden: false, ..Default::default() };
    named.lines.iter().map(of).collect()
}

fn hide(study: &mut Study, is_hidden: bool, listed: &[ListedLine]) -> Result<()> {
    let watch = Watch { stop: &|| false, progress: &Progress::default() };
    study.hide_bone(is_hidden, listed, watch)
}

fn values(held: &HeldVolume) -> &[i16] {
    match &held.stored {
        Stored::I16(values) => values,
        _ => &[],
    }
}

/// Whether each voxel belongs to a vessel of the phantom or its wall.
fn vessel_voxels(study: &Study) -> Vec<bool> {
    let volume = study.content.held.as_ref().expect("a scan").volume().expect("a volume");
    let voxels = Voxels::new(&volume);
    let mut is_vessel = vec![false; voxels.size.iter().product()];
    for one in listed(study) {
        let line = study.lines.get(one.line).expect("a line").met();
        for_each_voxel(&voxels, &line, &mut |n, _| is_vessel[n] = true);
    }
    is_vessel
}

#[test]
fn bone_is_hidden_and_no_voxel_of_a_vessel() {
    let mut study = opened();
    let (vessels, lines) = (vessel_voxels(&study), listed(&study));
    assert!(study.scene().expect("a scene").context.is_none());
    hide(&mut study, true, &lines).expect("bone");
    let scan = values(study.content.held.as_ref().expect("a scan"));
    let shown = values(study.content.around().expect("a volume"));
    let (mut compact, mut left) = (0, 0);
    for ((was, is), is_vessel) in scan.iter().zip(shown).zip(&vessels) {
        assert!(was == is || !is_vessel, "{was} became {is}");
        if *was > COMPACT && !is_vessel {
            compact += 1;
            left += usize::from(is == was);
        }
    }
    // Small parts stay, since they may be plaque, and so does what touches a vessel that was found.
    assert!(compact > 10_000 && 8 * left < compact, "{left} of {compact}");
}

#[test]
fn showing_bone_again_needs_no_search_and_leaves_the_scan_alone() {
    let mut study = opened();
    let lines = listed(&study);
    let before = values(study.content.held.as_ref().expect("a scan")).to_vec();
    hide(&mut study, true, &lines).expect("bone");
    assert!(study.scene().expect("a scene").context.is_some());
    hide(&mut study, false, &lines).expect("bone");
    assert!(study.scene().expect("a scene").context.is_none());
    assert_eq!(values(study.content.held.as_ref().expect("a scan")), before);
}

#[test]
fn a_vessel_that_is_listed_later_gets_its_voxels_back() {
    let mut study = opened();
    let lines = listed(&study);
    hide(&mut study, true, &lines).expect("bone");
    let hidden = {
        let (scan, shown) = (study.content.held.as_ref().expect("a scan"), study.content.around());
        let shown = values(shown.expect("a volume")).iter();
        let n = values(scan).iter().zip(shown).position(|(was, is)| was != is).expect("bone");
        let [ni, nj, _] = scan.size;
        let voxel = [n % ni, n / ni % nj, n / ni / nj].map(|c| c as f64);
        scan.world_from_index.transform_point3(glam::DVec3::from_array(voxel))
    };
    let end = hidden + glam::DVec3::Z;
    let line = Line { points: vec![hidden, end], radius: Some(vec![1.0; 2]), ..Line::default() };
    let new = ListedLine {
        line: study.lines.add(line).expect("a line"),
        name: String::new(),
        hidden: true,
        ..Default::default()
    };
    let key = study.content.around().expect("a volume").key.downgrade();
    hide(&mut study, true, &[&lines[..], &[new]].concat()).expect("bone");
    let (scan, shown) = (study.content.held.as_ref().expect("a scan"), study.content.around());
    let shown = shown.expect("a volume");
    assert_eq!(study.at(hidden.to_array()).value.map(f64::from), Some(f64::from(scan_value(scan, hidden))));
    assert_eq!(scan_value(scan, hidden), scan_value(shown, hidden));
    assert!(!key.is(&shown.key), "renderers must send it again");
}

fn scan_value(held: &HeldVolume, place: glam::DVec3) -> f32 {
    Voxels::new(&held.volume().expect("a volume")).at(place)
}

#[test]
fn without_a_vessel_or_a_scan_bone_is_refused() {
    let size = [24; 3];
    let voxels = Stored::I16(vec![0; 24 * 24 * 24]);
    let held = HeldVolume {
        stored: voxels,
        size,
        world_from_index: glam::DAffine3::IDENTITY,
        key: Default::default(),
        scan: Default::default(),
    };
    let mut study = Study::default();
    assert_eq!(hide(&mut study, true, &[]).expect_err("no scan").kind, "volume");
    study.content.held = Some(held);
    let refused = hide(&mut study, true, &[]).expect_err("no vessel");
    assert_eq!((refused.kind, refused.subject.as_str()), ("tracing", "bone"));
    assert!(study.content.without_bone.shown().is_none());
}
