//! Tests the behaviour of the study on which viewers rely.

mod after_edit;
mod doubts_on_opening;
mod edits;
mod finding;
mod generated;
mod lines;
mod lumens;
mod masks;
mod page_tables;
mod planes;
mod pretty;
mod trace_report;
mod tracing;
mod true_sides;
pub(crate) mod typescript;
mod whole_vessel;

use crate::backend::Backend;
use crate::devices::Wanted;
use crate::flight::flight;
use glam::DVec3;
use lumencut_core::pipeline::Request;
use lumencut_io::Space;
use lumencut_phantom::Phantom;
use serde_json::{Value as Json, json};

use crate::mends::{OfCenterlines, OfCore};
use crate::places::Statement;
use crate::study::centerline_files::AskedMessage;
use crate::study::held_volume::HeldVolume;
use crate::study::open_study::Study;
use crate::study::planes::Plane;
use crate::study::questions::ask_at_once;
use crate::study::straightened::{Aggregated, CprMessage};
use crate::study::view::{CameraMessage, ViewMessage};
use crate::study::voxels::Stored;

/// The statement that centerlines are in LPS.
pub(crate) const LPS: Statement = Statement { space: Some(Space::Lps), unit: None };

pub(crate) fn opened(phantom: &str) -> Study {
    let mut study = Study::default();
    open_phantom(&mut study, phantom);
    study
}

pub(crate) fn open_phantom(study: &mut Study, name: &str) {
    let made = match name {
        "stenosis" => lumencut_phantom::stenosis(50.0),
        "helix" => lumencut_phantom::helix(),
        "aorta" => lumencut_phantom::aorta(0, 1.0),
        "runoff" => lumencut_phantom::runoff(0, 1.0),
        "cervical" => lumencut_phantom::cervical(0, 1.0),
        _ => lumencut_phantom::y_junction(),
    };
    let Phantom { voxels, size, world_from_index, tree, vessel_names, .. } = made.expect("a phantom");
    let (stored, scan) = (Stored::I16(voxels), Default::default());
    let held = HeldVolume { stored, size, world_from_index, key: Default::default(), scan };
    study.open(held, tree, vessel_names).expect("a tree");
}

pub(crate) fn report_of(study: &Study) -> serde_json::Value {
    serde_json::to_value(study.report().expect("a report")).expect("JSON")
}

fn view(study: &Study, size: [usize; 2]) -> ViewMessage {
    let camera = serde_json::to_value(study.fitted("anterior", size).expect("a camera")).expect("JSON");
    let text = json!({"camera": camera, "method": "csr", "settings": {"window": [300.0, 900.0]}});
    ViewMessage::read(&text.to_string()).expect("a view")
}

fn on_first_vessel(study: &Study) -> (DVec3, f64) {
    let vessels = study.content.tree().expect("a tree").tree().vessels();
    let middle = vessels[0].points().len() / 2;
    (vessels[0].points()[middle], vessels[0].arc_length()[middle])
}

#[test]
fn a_pick_is_the_pixel_of_the_whole_picture() {
    let mut study = opened("stenosis");
    let view = study.view_of(&view(&study, [96, 80])).expect("a view");
    let scene = study.scene().expect("a scene");
    let request = Request::new(&view.camera, &view.settings);
    let (mut backend, _) = pollster::block_on(Backend::new(Wanted::Cpu)).expect("a CPU");
    let (frame, _) = pollster::block_on(backend.render_by(view.method, &scene, &request)).expect("a frame");
    let (depth, vessel) = (frame.depth().to_vec(), frame.vessel.clone());
    for (x, y) in [(48, 40), (10, 12), (90, 70), (50, 8)] {
        let pick = study.pick(&view, [x as f64, y as f64]).expect("a pick");
        let point = crate::positions::world_from_pixel(
            &view.camera,
            [x as f64, y as f64],
            f64::from(depth[y * 96 + x]),
        );
        // Picking renders only a part of the view; the result differs only by rounding.
        assert!(point.distance(DVec3::from_array(pick.point)) < 1e-3, "pixel {x}, {y}");
        // The tube is in the middle. Pixels outside it select no vessel, although the tube is the vessel nearest to all pixels.
        assert_eq!(vessel[y * 96 + x], 0);
        assert_eq!(pick.vessel, (x == 48 || x == 50).then_some(0), "pixel {x}, {y}");
    }
}

#[test]
fn a_focus_counts_for_nothing_once_no_vessels_are_shown() {
    let mut study = opened("stenosis");
    let mut message = view(&study, [96, 80]);
    message.settings.insert("focus".to_owned(), vec![2.0, 6.0].into());
    assert!(study.view_of(&message).expect("a view").settings.focus.is_some());
    study.show(&[]).expect("no vessels");
    assert!(study.view_of(&message).expect("a view").settings.focus.is_none());
}

#[test]
fn a_click_beside_a_vessel_means_it_as_far_as_it_is_seen_to_be_beside_it() {
    let mut study = opened("stenosis");
    let view = study.view_of(&view(&study, [96, 80])).expect("a view");
    let spacing = view.camera.pixel_spacing();
    // The tube is straight, upright and 8 mm wide at its lower end. Pixels up to four outside it still select it.
    let wall = 47.5 + 4.0 / spacing;
    let mut vessel = |x: f64| study.pick(&view, [x, 70.0]).expect("a pick").vessel;
    assert_eq!(vessel((wall + 3.0).floor()), Some(0));
    assert_eq!(vessel((wall + 6.0).ceil()), None);
}

#[test]
fn where_nothing_is_cut_a_click_means_the_brightest_place_on_its_ray() {
    let mut study = opened("stenosis");
    let mut view = study.view_of(&view(&study, [96, 80])).expect("a view");
    let cut = study.pick(&view, [48.0, 40.0]).expect("a pick");
    view.settings.focus = Some(lumencut_core::settings::Focus { margin: -1e6, fade: 0.0 });
    let brightest = study.brightest(&view, [48.0, 40.0]).expect("a place");
    assert_eq!(study.pick(&view, [48.0, 40.0]).expect("a pick"), brightest);
    assert!(brightest.value >= cut.value);
    // Outside the scan nothing is picked, and there is no error.
    let mut wide = view.clone();
    wide.camera = lumencut_core::camera::Camera::new(
        wide.camera.center(),
        wide.camera.direction(),
        wide.camera.up(),
        [96, 80],
        10.0 * wide.camera.pixel_spacing(),
    )
    .expect("a camera");
    let nothing = study.pick(&wide, [2.0, 2.0]).expect("a pick");
    assert_eq!((nothing.value, nothing.vessel), (None, None));
    // With a focus of 1 mm, the cut is shown in the lumen and the surroundings 10 mm outside the wall.
    view.settings.focus = Some(lumencut_core::settings::Focus { margin: 1.0, fade: 0.0 });
    assert_eq!(study.pick(&view, [48.0, 40.0]).expect("a pick"), cut);
    let beside = [(47.5 + 14.0 / view.camera.pixel_spacing()).round(), 40.0];
    let around = study.brightest(&view, beside).expect("a place");
    assert_eq!(study.pick(&view, beside).expect("a pick"), around);
}

#[test]
fn a_slab_limits_no_ray_where_a_focus_shows_what_lies_around_the_vessels() {
    let mut study = opened("stenosis");
    let mut view = study.view_of(&view(&study, [96, 80])).expect("a view");
    view.settings.focus = Some(lumencut_core::settings::Focus { margin: 1.0, fade: 0.0 });
    let (inside, beside) = ([48.0, 40.0], [(47.5 + 14.0 / view.camera.pixel_spacing()).round(), 40.0]);
    let cut = study.pick(&view, inside).expect("a pick");
    let around = study.brightest(&view, beside).expect("a place");
    view.settings.slab =
        Some(lumencut_core::settings::Slab { thickness: 0.5, mode: lumencut_core::settings::SlabMode::Max });
    assert_eq!(study.pick(&view, beside).expect("a pick"), around);
    assert_eq!(study.brightest(&view, beside).expect("a place"), around);
    // Within the lumen the slab limits the ray.
    let brightest = study.brightest(&view, inside).expect("a place").point;
    let far = DVec3::from_array(brightest).distance(DVec3::from_array(cut.point));
    assert!(far <= 0.25 + view.camera.pixel_spacing(), "{far} mm beside the cut");
}

#[test]
fn a_place_on_a_vessel_is_told_with_its_arc_length() {
    let study = opened("y_junction");
    let (point, along) = on_first_vessel(&study);
    let at = study.at(point.to_array());
    assert_eq!(at.vessel, Some(0));
    assert!((at.arc_length.expect("a place") - along).abs() < 1e-9);
    assert!(at.value.expect("inside") > 200.0);
    let outside = study.at([1e4, 0.0, 0.0]);
    assert_eq!((outside.vessel, outside.value), (None, None));
}

#[test]
fn a_slice_shows_the_voxels_of_its_plane() {
    let study = opened("y_junction");
    let (point, _) = on_first_vessel(&study);
    let plane = Plane {
        center: point.to_array(),
        right: [1.0, 0.0, 0.0],
        down: [0.0, 1.0, 0.0],
        size: [3, 3],
        pixel_spacing: 0.2,
        slab: None,
    };
    let value = study.at(point.to_array()).value.expect("inside");
    let picture = study.slice(&plane, [f64::from(value), 200.0]).expect("a slice");
    // The level of a window appears as middle grey.
    assert!((i32::from(picture.bytes[4 * 4]) - 128).abs() <= 1);
    assert_eq!(picture.bytes.len(), 3 * 3 * 4);
    let away = Plane { center: [1e4, 0.0, 0.0], ..plane };
    let nothing = study.slice(&away, [0.0, 1.0]).expect("a slice");
    assert!(nothing.bytes.chunks_exact(4).all(|pixel| pixel[..3] == [0, 0, 0]));
}

#[test]
fn the_straightened_vessel_runs_down_the_middle() {
    let mut study = opened("stenosis");
    assert_eq!(study.pick_straightened([0.0, 0.0]).expect_err("none is shown").subject, "CPR");
    assert!(study.on_straightened([0.0; 3]).is_none());
    let message =
        CprMessage { vessel: 0, angle: 0.0, width: 20.0, pixel_spacing: 0.5, feature: None, roll: None };
    let picture = study.straightened(message, ([300.0, 900.0], &|| false)).expect("a CPR");
    let [width, height] = picture.size;
    for row in [2, height / 2, height - 3] {
        let place = [(width - 1) as f64 / 2.0, row as f64];
        let middle = study.pick_straightened(place).expect("a pick");
        let along = study.at(middle.point).arc_length.expect("in the lumen");
        assert!((along - middle.arc_length).abs() < 0.5 && middle.vessel == 0 && middle.value.is_some());
        let pixel = study.on_straightened(middle.point).expect("a pixel");
        assert!((pixel[0] - place[0]).abs() < 0.1 && (pixel[1] - place[1]).abs() < 0.1);
    }
    let turned = CprMessage { angle: 1.0, ..message };
    assert_eq!(study.straightened(turned, ([300.0, 900.0], &|| false)).expect("a CPR").size, picture.size);
}

#[test]
fn voxels_come_in_parts_and_must_fit() {
    let mut study = Study::default();
    let header = json!({"size": [2, 2, 2], "dtype": "int16", "world_from_index":
        [[1.0, 0.0, 0.0, -5.0], [0.0, 2.0, 0.0, 0.0], [0.0, 0.0, 3.0, 0.0], [0.0, 0.0, 0.0, 1.0]]});
    study.begin_volume(&header.to_string()).expect("room");
    study.voxel_bytes(2, 2).expect("room").copy_from_slice(&700i16.to_le_bytes());
    assert_eq!(study.at([-4.0, 0.0, 0.0]).value, Some(700.0));
    assert_eq!(study.voxel_bytes(15, 2).expect_err("beyond").kind, "volume");
    let odd = header.to_string().replace("int16", "complex64");
    assert_eq!(study.begin_volume(&odd).expect_err("odd").found, "complex64");
    let huge = header.to_string().replace("[2,2,2]", "[4000000000,4000000000,4000000000]");
    assert_eq!(study.begin_volume(&huge).expect_err("too many").kind, "volume");
}

#[test]
fn a_broken_file_of_centerlines_leaves_the_tree() {
    let mut study = opened("y_junction");
    let error = study.open_centerlines(b"<VTKFile", "tree.vtp", Statement::default()).expect_err("broken");
    assert_eq!(error.kind, "format");
    assert!(study.content.tree().is_some());
    let points = study.content.tree().expect("a tree").tree().vessels()[0].points().to_vec();
    let rows = points.iter().map(|p| format!("{},{},{},1.5\n", p.x, p.y, p.z)).collect::<String>();
    let text = format!("x,y,z,radius\n{rows}");
    // The mirrored lines fit the phantom equally well.
    let failure =
        study.open_centerlines(text.as_bytes(), "line.csv", Statement::default()).expect_err("no space");
    assert_eq!(failure.more.mends, [OfCenterlines::Coordinates.into()]);
    study.open_centerlines(text.as_bytes(), "line.csv", LPS).expect("a line");
    assert_eq!(study.content.tree().map(|tree| tree.tree().vessels().len()), Some(1));
}

#[test]
fn centerlines_are_read_in_the_space_and_unit_that_are_asked_for() {
    let mut study = opened("stenosis");
    let asked = json!({"coordinates": "ras", "unit": "cm", "fill_gaps": true}).to_string();
    let asked: AskedMessage = serde_json::from_str(&asked).expect("a message");
    let lines = b"x,y,z\n0,0,-1\n1,0,1\n";
    study.open_centerlines(lines, "line.csv", asked).expect("a line");
    let points = study.content.tree().expect("a tree").tree().vessels()[0].points().to_vec();
    assert_eq!(points, [DVec3::new(0.0, 0.0, -10.0), DVec3::new(-10.0, 0.0, 10.0)]);
    assert_eq!(AskedMessage::default().statement(), Statement::default());
}

#[test]
fn the_report_names_vessels_and_windows() {
    let study = opened("stenosis");
    let report = report_of(&study);
    assert_eq!(report["vessels"].as_array().map(Vec::len), Some(1));
    let windows = &report["windows"];
    assert!(windows["main"][1].as_f64().expect("a width") > 0.0);
    assert_eq!(windows["contexts"]["mip"], windows["main"]);
    assert_ne!(windows["contexts"]["average"], windows["main"]);
    let presets = windows["presets"].as_array().expect("a list");
    assert_eq!(presets[0], json!({"name": "auto", "words": "From the data", "window": windows["main"]}));
    assert_eq!(presets[1], json!({"name": "cta", "words": "CT angiography", "window": [300.0, 900.0]}));
    assert_eq!(presets.len(), crate::window_presets::WINDOW_PRESETS.len());
    assert!(report_of(&Study::default())["volume"].is_null());
}

#[test]
fn messages_that_are_none_are_refused() {
    assert!(ViewMessage::read("{}").is_err());
    let study = opened("y_junction");
    let odd = ViewMessage { method: "xyz".into(), ..view(&study, [8, 8]) };
    assert_eq!(odd.view().expect_err("no method").subject, "method");
}

#[test]
fn the_views_of_a_flight_are_told_without_a_study() {
    let camera = |center: [f64; 3], spacing: f64| {
        json!({"center": center, "direction": [0.0, 1.0, 0.0],
        "up": [0.0, 0.0, 1.0], "size": [400, 300], "pixel_spacing": spacing})
    };
    let (from, to) = (camera([0.0; 3], 2.0), camera([8.0, 0.0, 4.0], 0.5));
    let asked = |from: &Json, views: usize| {
        let message = json!({"from": from, "to": to, "views": views}).to_string();
        ask_at_once("flight", &message)
            .map(|answer| serde_json::from_str::<Vec<CameraMessage>>(&answer.json).unwrap())
    };
    let views = asked(&from, 7).expect("views");
    let told: Vec<_> = views.iter().map(|view| view.camera().expect("a camera")).collect();
    let ends = [&from, &to]
        .map(|end| serde_json::from_value::<CameraMessage>(end.clone()).unwrap().camera().unwrap());
    assert_eq!(told, flight(&ends[0], &ends[1], 7).expect("a flight"));
    assert_eq!([told[0], told[6]], ends);
    let mut blind = from.clone();
    blind["direction"] = json!([0.0, 0.0, 0.0]);
    for (bad, views) in [(blind, 7), (from, 1)] {
        assert_eq!(asked(&bad, views).map_err(|failure| failure.kind), Err("camera"));
    }
}

#[test]
fn a_feature_aggregation_is_as_bright_as_its_circles() {
    let mut study = opened("stenosis");
    let plain =
        CprMessage { vessel: 0, angle: 0.0, width: 20.0, pixel_spacing: 0.5, feature: None, roll: None };
    let shown =
        |study: &mut Study, message| study.straightened(message, ([300.0, 900.0], &|| false)).expect("a CPR");
    let (least, most) = (CprMessage { feature: Some(Aggregated::Min), ..plain }, Some(Aggregated::Max));
    let [least, own, most] =
        [least, plain, CprMessage { feature: most, ..plain }].map(|m| shown(&mut study, m));
    assert_eq!((least.size, most.size), (own.size, own.size));
    // The samples of the half circle may miss the direction of the pixel by half a step.
    let brighter = |a: &[u8], b: &[u8]| a.iter().zip(b).all(|(a, b)| i32::from(*a) + 2 >= i32::from(*b));
    assert!(brighter(&most.bytes, &least.bytes));
    let middle = own.size[0] / 2 + own.size[0] * (own.size[1] / 2);
    assert_eq!(least.bytes[4 * middle..][..4], own.bytes[4 * middle..][..4]);
    assert_eq!(most.bytes[4 * middle..][..4], own.bytes[4 * middle..][..4]);
}

#[test]
fn where_memory_is_short_it_is_told_how_much_is_needed() {
    let size = [40_000, 40_000, 4_000_000];
    let header = json!({"size": size, "dtype": "float32", "world_from_index":
        [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]]});
    let failure = Study::default().begin_volume(&header.to_string()).expect_err("too much");
    assert_eq!((failure.kind, failure.found.as_str()), ("volume", "25600000000 MB of voxels"));
    assert_eq!(failure.mend, "close other pages");
    assert_eq!(failure.more.mends, [OfCore::EverySecond.into()]);
}
