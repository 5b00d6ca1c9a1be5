//! The table of stages agrees with the shaders, with the order of stages, and with the images that they need.
#![allow(clippy::unwrap_used)]

use glam::{DVec3, Vec3};
use lumencut_core::camera::Camera;
use lumencut_core::geometry::{Curved, Geometry};
use lumencut_core::math::lanes::Isa;
use lumencut_core::settings::{Focus, RimValue, Settings, SilhouetteRule};
use lumencut_core::shaders::SHADERS;
use lumencut_core::stages::depth_filter::{DepthFilterParameters, depth_filter};
use lumencut_core::stages::{Image, ImageSet, Stage, Work};
use lumencut_scenes::views::front;

/// The stages of a whole picture.
fn whole(settings: &Settings) -> Vec<Stage> {
    let surface = Stage::of_cut_surface(settings, ImageSet::ALL);
    let made = ImageSet::of(&[Image::Depth, Image::Vessel, Image::Leap]);
    let look = Stage::of_look(settings, &Geometry::rays(front([4, 3], 1.0)), made, ImageSet::ALL);
    surface.into_iter().chain(look).collect()
}

#[test]
fn every_stage_that_writes_images_has_a_shader_of_its_name() {
    for stage in Stage::ALL.into_iter().filter(|stage| !stage.writes().is_empty()) {
        let room = format!("stages/{}", stage.name());
        assert!(SHADERS.iter().any(|shader| shader.room == room), "no shader {room}");
    }
    let of_stages = SHADERS.iter().filter_map(|shader| shader.room.strip_prefix("stages/"));
    for name in of_stages {
        assert!(Stage::ALL.iter().any(|stage| stage.name() == name), "no stage {name}");
    }
}

#[test]
fn names_are_unique() {
    for stage in Stage::ALL {
        assert_eq!(Stage::ALL.iter().filter(|other| other.name() == stage.name()).count(), 1, "{stage:?}");
    }
}

#[test]
fn stages_run_in_the_order_of_the_table() {
    for settings in
        [Settings::default(), Settings { depth_filter: false, context: None, ..Settings::default() }]
    {
        let places =
            whole(&settings).into_iter().map(|stage| Stage::ALL.iter().position(|s| *s == stage).unwrap());
        assert!(places.is_sorted());
    }
}

#[test]
fn every_image_is_written_before_it_is_read() {
    // The request has the depth of the view before.
    let mut made = ImageSet::of(&[Image::Before]);
    for stage in whole(&Settings {
        focus: Some(Focus::default()),
        rim: Some(RimValue::Diameter),
        ..Settings::default()
    }) {
        for image in stage.reads() {
            assert!(made.has(*image), "{stage:?} reads {image:?} before it is there");
        }
        made = made.and(ImageSet::of(stage.writes()));
    }
    assert!(Image::ALL.into_iter().all(|image| made.has(image)));
}

#[test]
fn what_is_not_wanted_is_not_run() {
    let settings = Settings { depth_filter: false, silhouettes: false, context: None, ..Settings::default() };
    assert_eq!(whole(&settings), [Stage::Distance, Stage::Depth, Stage::Surface, Stage::Composite]);
    let rays = Geometry::rays(front([4, 3], 1.0));
    let look = |geometry: &Geometry, made: &[Image]| {
        Stage::of_look(&Settings::default(), geometry, ImageSet::of(made), ImageSet::ALL)
    };
    let alone = [Stage::Blocks, Stage::Context, Stage::Composite];
    assert_eq!(look(&rays, &[]), alone);
    assert_eq!(look(&rays, &[Image::Vessel]), alone, "silhouettes are lines of the depth");
    let curved = Curved::new([1, 1], vec![DVec3::ZERO], vec![Vec3::Z]).unwrap();
    assert_eq!(look(&Geometry::Curved(curved), &[]), [Stage::Surface, Stage::Composite]);
}

#[test]
fn what_nothing_reads_is_not_made() {
    let leaps = Settings { depth_filter: false, silhouette_reach: None, ..Settings::default() };
    let own = Settings { silhouette_rule: SilhouetteRule::Gradient, ..leaps.clone() };
    let stages = |settings: &Settings, wanted: &[Image]| {
        let wanted = ImageSet::of(wanted);
        (Stage::of_cut_surface(settings, wanted), Stage::has_sheet(settings, wanted))
    };
    assert_eq!(stages(&own, &[Image::Picture]), (vec![Stage::Depth], false));
    assert_eq!(stages(&own, &[Image::Distance]), (vec![Stage::Distance, Stage::Depth], false));
    assert_eq!(stages(&own, &[Image::Sheet]), (vec![Stage::Depth], true));
    assert_eq!(stages(&leaps, &[Image::Depth]), (vec![Stage::Depth], false));
    assert_eq!(stages(&leaps, &[Image::Picture]), (vec![Stage::Depth, Stage::Leap], true));
    let quiet = Settings { silhouette_reach: Some(10.0), ..leaps };
    let with_reach = vec![Stage::Depth, Stage::Leap, Stage::Focus, Stage::FarRim];
    assert_eq!(stages(&quiet, &[Image::Picture]), (with_reach, true));
    assert_eq!(stages(&quiet, &[Image::Depth, Image::Context]), (vec![Stage::Depth], false));
    let paper = Settings { depth_filter: false, ..Settings::paper() };
    assert_eq!(stages(&paper, &[Image::Picture]), (vec![Stage::Distance, Stage::Depth], false));
}

#[test]
fn a_look_makes_no_more_than_what_is_wanted() {
    let (settings, rays) = (Settings::default(), Geometry::rays(front([4, 3], 1.0)));
    let curved = Geometry::Curved(Curved::new([1, 1], vec![DVec3::ZERO], vec![Vec3::Z]).unwrap());
    let made = ImageSet::of(&[Image::Depth, Image::Vessel, Image::Leap]);
    let look = |geometry: &Geometry, wanted: Image| {
        Stage::of_look(&settings, geometry, made, ImageSet::of(&[wanted]))
    };
    assert_eq!(look(&rays, Image::Depth), []);
    assert_eq!(look(&rays, Image::Value), [Stage::Surface]);
    let context = [Stage::Surface, Stage::Blocks, Stage::Context, Stage::Composite];
    assert_eq!(look(&rays, Image::Context), context);
    assert_eq!(look(&curved, Image::Value), [Stage::Surface]);
    assert_eq!(look(&curved, Image::Picture), [Stage::Surface, Stage::Composite]);
}

#[test]
#[should_panic(expected = "entries of the image UnfilteredDepth of 4 × 3 pixels")]
fn images_of_another_size_are_refused() {
    let camera: Camera = front([4, 3], 1.0);
    let work = Work { size: camera.size(), isa: Isa::Baseline, stop: &|| false, progress: None };
    let _ = depth_filter(&work, &DepthFilterParameters::new(), &[0.0; 11], None, &mut [0.0; 12]);
}
