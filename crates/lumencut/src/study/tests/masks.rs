//! Tests of masks with a volume, and of the brightest place on a ray.

use glam::{DAffine3, DMat4, DVec3};
use lumencut_core::progress::Progress;
use serde_json::json;

use super::opened;
use crate::study::failure::Failure;
use crate::study::masks::MaskLines;
use crate::study::open_study::Study;
use crate::study::picking::Pick;
use crate::study::tracing::Watch;
use crate::study::view::ViewMessage;

pub(super) fn grid(study: &Study) -> ([usize; 3], DAffine3) {
    let held = study.content.held.as_ref().expect("a volume");
    (held.size, held.world_from_index)
}

pub(super) fn header((size, world_from_index): ([usize; 3], DAffine3), dtype: &str) -> String {
    let rows = DMat4::from(world_from_index).transpose().to_cols_array_2d();
    json!({"size": size, "dtype": dtype, "world_from_index": rows}).to_string()
}

pub(super) fn values(study: &Study) -> Vec<i16> {
    match &study.content.held.as_ref().expect("a volume").stored {
        crate::study::voxels::Stored::I16(values) => values.clone(),
        other => panic!("{other:?}"),
    }
}

fn traced(study: &mut Study, header: &str, bytes: &[u8]) -> Result<MaskLines, Failure> {
    study.begin_mask(header)?;
    study.mask_bytes(0, bytes.len())?.copy_from_slice(bytes);
    let traced = study.trace_mask(Watch { stop: &|| false, progress: &Progress::default() });
    assert!(study.mask.is_none(), "the mask is forgotten");
    traced
}

#[test]
fn the_lines_of_a_mask_are_those_of_the_vessels() {
    let mut study = opened("y_junction");
    let bytes: Vec<u8> = values(&study).iter().map(|value| u8::from(*value > 205)).collect();
    let header = header(grid(&study), "uint8");
    let made = traced(&mut study, &header, &bytes).expect("lines");
    assert!(made.lines.len() == 3 && made.lines.iter().all(|named| named.name.is_empty()));
    for vessel in 0..3 {
        let truth = study.lines.get(vessel).expect("a line");
        let middle = truth.points[truth.points.len() / 2];
        let near = made.lines.iter().map(|named| study.lines.get(named.line).expect("a line"));
        let away = near.flat_map(|line| line.points.clone()).map(|point| point.distance(middle));
        assert!(away.fold(f64::MAX, f64::min) < 0.6);
    }
    // The line was refined by the volume's grey values.
    let line = study.lines.get(made.lines[0].line).expect("a line");
    assert!(line.confidence.is_some() && line.bridged.as_ref().is_some_and(|marks| !marks.contains(&true)));
}

#[test]
fn labels_name_the_lines_also_where_they_are_floats() {
    let mut study = opened("stenosis");
    let (size, affine) = grid(&study);
    let slice = size[0] * size[1];
    let label = |(n, value): (usize, &i16)| match value {
        v if *v < 205 => 0.0,
        _ if n / slice < size[2] / 2 => 4.0f32,
        _ => 9.0,
    };
    let labels: Vec<f32> = values(&study).iter().enumerate().map(label).collect();
    let bytes: Vec<u8> = labels.iter().flat_map(|label| label.to_le_bytes()).collect();
    let made = traced(&mut study, &header((size, affine), "float32"), &bytes).expect("lines");
    let mut names: Vec<&str> = made.lines.iter().map(|named| named.name.as_str()).collect();
    names.sort_unstable();
    assert_eq!(names, ["label 4", "label 9"]);
}

/// A mask that is a box of the volume's voxels and begins at `low`, with its header.
fn cropped(study: &Study, low: [usize; 3], size: [usize; 3], names: &serde_json::Value) -> (String, Vec<u8>) {
    let ([ni, nj, _], affine) = grid(study);
    let every = values(study);
    let mut bytes = Vec::new();
    for k in 0..size[2] {
        for j in 0..size[1] {
            for i in 0..size[0] {
                bytes.push(u8::from(every[(low[2] + k) * ni * nj + (low[1] + j) * ni + low[0] + i] > 205));
            }
        }
    }
    let moved = affine * DAffine3::from_translation(DVec3::from(low.map(|n| n as f64)));
    let text = header((size, moved), "uint8");
    let mut fields: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    fields["label_names"] = names.clone();
    (fields.to_string(), bytes)
}

#[test]
fn a_mask_of_a_part_is_placed_by_its_own_grid_and_named_by_its_file() {
    let mut study = opened("stenosis");
    let (whole, _) = grid(&study);
    let (every, bytes) = cropped(&study, [0; 3], whole, &json!({}));
    let expected = traced(&mut study, &every, &bytes).expect("lines");
    let inside = values(&study).iter().enumerate().filter(|(_, value)| **value > 205).map(|(n, _)| n).fold(
        ([usize::MAX; 3], [0; 3]),
        |(low, high), n| {
            let at = [n % whole[0], n / whole[0] % whole[1], n / whole[0] / whole[1]];
            (std::array::from_fn(|a| low[a].min(at[a])), std::array::from_fn(|a| high[a].max(at[a])))
        },
    );
    let size = std::array::from_fn(|a| inside.1[a] - inside.0[a] + 1);
    assert!(size.iter().zip(&whole).any(|(own, every)| own < every));
    let (part, bytes) = cropped(&study, inside.0, size, &json!({"1": "aorta"}));
    let made = traced(&mut study, &part, &bytes).expect("lines");
    assert!(made.notes[0].contains("placed by its own grid"), "{:?}", made.notes);
    assert_eq!(made.lines.len(), expected.lines.len());
    for (own, other) in made.lines.iter().zip(&expected.lines) {
        assert_eq!((own.name.as_str(), other.name.as_str()), ("aorta", ""));
        let [own, other] = [own.line, other.line].map(|line| study.lines.get(line).expect("a line"));
        assert_eq!((&own.points, &own.radius), (&other.points, &other.radius));
    }
}

#[test]
fn masks_that_are_none_are_refused() {
    let mut study = opened("stenosis");
    let (size, affine) = grid(&study);
    let count: usize = size.iter().product();
    let own = header((size, affine), "uint8");
    let shifted = DAffine3::from_translation(DVec3::X) * affine;
    let empty = vec![0u8; count];
    study.check_mask(&own).expect("its own grid");
    study.check_mask(&header((size, shifted), "uint8")).expect_err("the grid alone shows that it is none");
    let failure = traced(&mut study, &header((size, shifted), "uint8"), &empty).expect_err("elsewhere");
    assert!(failure.found.contains("corners lie up to 1 mm"), "{}", failure.found);
    let larger = [size[0] + 1, size[1], size[2]];
    let zeros = vec![0u8; larger.iter().product()];
    let failure = traced(&mut study, &header((larger, affine), "uint8"), &zeros).expect_err("more");
    assert!(failure.found.contains("extends beyond the volume") && failure.mend.contains("resample"));
    assert_eq!(traced(&mut study, &own, &empty).expect_err("nothing").kind, "volume");
    let many: Vec<u8> = (0..count).flat_map(|n| ((n % 3000) as i16).to_le_bytes()).collect();
    let failure = traced(&mut study, &header((size, affine), "int16"), &many).expect_err("a scan");
    assert!(failure.found.contains("more distinct values, as in a scan"));
    let half: Vec<u8> = (0..count).flat_map(|_| 0.5f32.to_le_bytes()).collect();
    let failure = traced(&mut study, &header((size, affine), "float32"), &half).expect_err("shares");
    assert_eq!(failure.found, "a voxel of 0.5");
    assert!(Study::default().begin_mask(&own).is_err());
}

/// A volume of 5 × 5 × 11 mm in 1 mm voxels, 0 except some voxels of its middle column.
fn column(bright: &[(usize, i16)]) -> Study {
    let mut study = Study::default();
    study.begin_volume(&header(([5, 5, 11], DAffine3::IDENTITY), "int16")).expect("room");
    for (k, value) in bright {
        let at = 2 * (k * 25 + 12);
        study.voxel_bytes(at, 2).expect("a voxel").copy_from_slice(&value.to_le_bytes());
    }
    study
}

/// The brightest place, seen from above with these settings, at a pixel of a 5 × 5 mm picture.
fn brightest(study: &mut Study, pixel: [f64; 2], settings: &serde_json::Value) -> Result<Pick, Failure> {
    let camera = json!({"center": [2, 2, 0], "direction": [0, 0, 1], "up": [0, 1, 0], "size": [5, 5], "pixel_spacing": 1});
    let text = json!({"camera": camera, "method": "csr", "settings": settings}).to_string();
    let view = study.view_of(&ViewMessage::read(&text)?)?;
    study.brightest(&view, pixel)
}

#[test]
fn the_brightest_voxel_of_a_ray_is_found() {
    let mut study = column(&[(3, 200), (7, 500), (9, 499)]);
    let pick = brightest(&mut study, [2.0, 2.0], &json!({})).expect("a place");
    assert_eq!((pick.point, pick.value), ([2.0, 2.0, 7.0], Some(500.0)));
    // Of voxels with equal values the nearer one is chosen.
    let mut alike = column(&[(3, 500), (7, 500)]);
    assert_eq!(brightest(&mut alike, [2.0, 2.0], &json!({})).expect("a place").point, [2.0, 2.0, 3.0]);
    let failure = brightest(&mut study, [9.0, 2.0], &json!({})).expect_err("beside");
    assert_eq!((failure.kind, failure.found.as_str()), ("tracing", "a ray that meets no voxel"));
    assert_eq!(brightest(&mut Study::default(), [2.0, 2.0], &json!({})).expect_err("nothing").kind, "volume");
}

#[test]
fn a_slab_limits_the_ray_to_itself() {
    let mut study = column(&[(3, 200), (7, 500)]);
    let line = json!({"points": [[0, 2, 3], [4, 2, 3]], "radius": null, "confidence": null, "bridged": null});
    let line = study.add_line(serde_json::from_value(line).expect("a line")).expect("a line");
    study
        .show(&[crate::study::lines::ListedLine {
            line,
            name: String::new(),
            hidden: false,
            ..Default::default()
        }])
        .expect("a tree");
    let slab = json!({"slab": [3.0, "max"]});
    assert_eq!(brightest(&mut study, [2.0, 2.0], &slab).expect("a place").point, [2.0, 2.0, 3.0]);
    assert_eq!(brightest(&mut study, [2.0, 2.0], &json!({})).expect("a place").point, [2.0, 2.0, 7.0]);
}
