//! The outline of the body, compared with its closed form, and where it is left out.
#![allow(clippy::unwrap_used)]

use glam::{DAffine3, DMat3, DVec3};
use lumencut_core::camera::Camera;
use lumencut_core::frame::Frame;
use lumencut_core::pipeline::{CpuRenderer, Request};
use lumencut_core::scene::Scene;
use lumencut_core::settings::{Context, Focus, Settings};
use lumencut_core::volume::{Volume, Voxels};
use lumencut_scenes::trees::{tree, vessel};
use lumencut_scenes::views::front;

const SIZE: [usize; 3] = [100, 90, 80];
const SPACING: f64 = 2.5;

/// A cylinder along z of 70 mm in air; at `crop`, the scan is full of tissue.
fn scan(is_crop: bool) -> Vec<i16> {
    let middle = |n: usize, a: usize| SPACING * (n as f64 - (SIZE[a] as f64 - 1.0) / 2.0);
    let value = |n: usize| {
        let (x, y) = (middle(n % SIZE[0], 0), middle(n / SIZE[0] % SIZE[1], 1));
        if is_crop || x.hypot(y) < 70.0 { 40 } else { -1000 }
    };
    (0..SIZE.iter().product()).map(value).collect()
}

fn volume(voxels: &[i16]) -> Volume<'_> {
    let middle = DVec3::from_array(SIZE.map(|n| (n as f64 - 1.0) / 2.0));
    let affine =
        DAffine3::from_mat3_translation(DMat3::from_diagonal(DVec3::splat(SPACING)), -SPACING * middle);
    Volume::new(Voxels::I16(voxels), SIZE, [1, SIZE[0], SIZE[0] * SIZE[1]], affine).unwrap()
}

fn settings(body: bool) -> Settings {
    let focus = Some(Focus { margin: 1.0, fade: 2.0 });
    Settings { focus, context: Some(Context { body, ..Context::default() }), ..Settings::default() }
}

fn shown(voxels: &[i16], camera: &Camera, settings: &Settings) -> Frame {
    // A vessel far from the border of the body.
    let tree = tree(vec![vessel(&[[0.0, 0.0, -30.0], [0.0, 0.0, 30.0]], 4.0)]);
    CpuRenderer::default().render(&Scene::new(volume(voxels), tree), &Request::new(camera, settings)).unwrap()
}

#[test]
fn the_outline_is_the_closed_form_of_the_distance_from_the_border() {
    let camera = front([240, 40], 1.0);
    let frame = shown(&scan(false), &camera, &settings(true));
    let row = &frame.context[20 * 240..21 * 240];
    let brightest = |columns: std::ops::Range<usize>| columns.max_by_key(|i| row[*i][3]).unwrap();
    let expected = |mm: f64| 255.0 * (0.05 + 0.13 * (-mm / 8.0).exp());
    for (columns, sign) in [(0..120, -1.0), (120..240, 1.0)] {
        let border = camera.view_x(brightest(columns));
        assert!((border * sign - 70.0).abs() < 3.0, "the line lies at {border} mm");
        for mm in [6.0, 12.0, 24.0] {
            let at = ((border - sign * mm) + 119.5).round() as usize;
            assert!((f64::from(row[at][3]) - expected(mm)).abs() < 4.0, "{mm} mm within: {:?}", row[at]);
        }
    }
    assert!(row[..40].iter().all(|pixel| pixel[3] == 0), "nothing lies in the air");
}

#[test]
fn the_ends_at_the_faces_of_the_scan_are_not_outlined() {
    let camera = front([120, 240], 1.0);
    let frame = shown(&scan(false), &camera, &settings(true));
    let column: Vec<u8> = (0..240).map(|row| frame.context[row * 120 + 20][3]).collect();
    assert!(column[119] > 10, "the body shows in the middle");
    let end = column.iter().position(|alpha| *alpha > 2).unwrap();
    let steps = column.windows(2).map(|pair| pair[0].abs_diff(pair[1])).max().unwrap();
    assert!(end > 20 && steps <= 2, "it begins at row {end}, in steps of at most {steps}");
}

#[test]
fn it_changes_no_pixel_of_the_cut_and_none_without_air() {
    let camera = front([200, 120], 1.2);
    for (is_crop, changes) in [(false, true), (true, false)] {
        let voxels = scan(is_crop);
        let [without, with] = [false, true].map(|body| shown(&voxels, &camera, &settings(body)));
        assert_eq!((without.depth(), without.vessel.len()), (with.depth(), with.vessel.len()));
        assert_eq!(without.image != with.image, changes);
        let centre = 60 * 200 + 100;
        assert_eq!(without.image[centre], with.image[centre], "in the lumen");
    }
    let mut preview = settings(true);
    preview.context.as_mut().unwrap().preview = true;
    let frame = shown(&scan(false), &camera, &preview);
    assert!(frame.timings.iter().all(|timing| timing.stage != "body"), "while the view moves");
}
