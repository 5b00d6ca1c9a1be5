//! The focus, compared with closed forms and an independent distance; at its limits: CSR, and only context.
#![allow(clippy::unwrap_used)]

use glam::{DVec2, DVec3};
use lumencut_core::camera::Camera;
use lumencut_core::error::ErrorKind;
use lumencut_core::frame::Frame;
use lumencut_core::math::lanes::Isa;
use lumencut_core::pipeline::{CpuRenderer, Request};
use lumencut_core::scene::Scene;
use lumencut_core::settings::{Context, ContextFrom, ContextMode, Focus, Opacity, Settings, SilhouetteRule};
use lumencut_core::stages::{Image, ImageSet};
use lumencut_core::vessel_tree::{Vessel, VesselTree};
use lumencut_phantom::{Phantom, crossing, y_junction};
use lumencut_scenes::pictures::context_alone;
use lumencut_scenes::random_tree::random_tree;
use lumencut_scenes::trees::{tree, vessel};
use lumencut_scenes::views::{at, front, view};

fn with_focus(margin: f64, fade: f64) -> Settings {
    Settings { focus: Some(Focus { margin, fade }), ..Settings::default() }
}

fn framed(scene: &Scene, camera: &Camera, settings: &Settings, isa: Isa) -> Frame {
    let images = ImageSet::ALL.and(ImageSet::of(&[Image::Focus]));
    CpuRenderer::new(isa).render(scene, &Request { images, ..Request::new(camera, settings) }).unwrap()
}

fn of_surface(frame: &Frame) -> Vec<f32> {
    frame.focus.iter().map(|shares| shares[0]).collect()
}

/// The shares for a tree without a volume.
fn shares(tree: &VesselTree, camera: &Camera, settings: &Settings) -> Vec<f32> {
    of_surface(&framed(&Scene::default().with_tree(tree.clone()), camera, settings, Isa::widest()))
}

fn shown(phantom: &Phantom, camera: &Camera, settings: &Settings) -> Frame {
    let scene = Scene::new(phantom.volume().unwrap(), phantom.tree.clone());
    framed(&scene, camera, settings, Isa::widest())
}

fn share(beyond: f64, margin: f64, fade: f64) -> f64 {
    let away = ((beyond - margin) / fade).clamp(0.0, 1.0);
    1.0 - away * away * (3.0 - 2.0 * away)
}

/// The distance of a view position from the nearest of many discs along the vessels.
fn beyond_discs(tree: &VesselTree, camera: &Camera, place: DVec2) -> f64 {
    let mut nearest = f64::MAX;
    for vessel in tree.vessels() {
        for (n, ends) in vessel.points().windows(2).enumerate() {
            let [from, to] = [ends[0], ends[1]].map(|point| camera.view_from_world(point).truncate());
            let [first, last] = [n, n + 1].map(|n| vessel.radius_or_zero(n));
            for step in 0..=400 {
                let t = f64::from(step) / 400.0;
                let radius = first + (last - first) * t;
                nearest = nearest.min((place - from.lerp(to, t)).length() - radius);
            }
        }
    }
    nearest.max(0.0)
}

#[test]
fn beside_one_tube_the_share_is_the_closed_form() {
    let tube = tree(vec![vessel(&[[-100.0, 3.0, 0.0], [100.0, -2.0, 0.0]], 4.0)]);
    let camera = front([48, 64], 0.5);
    let frame = framed(&Scene::default().with_tree(tube), &camera, &with_focus(2.0, 6.0), Isa::widest());
    for row in 0..64 {
        let y = camera.view_y(row);
        let expected = share((y.abs() - 4.0).max(0.0), 2.0, 6.0);
        assert!((f64::from(at(&frame, &of_surface(&frame), 0.25, y)) - expected).abs() < 1e-5, "at {y} mm");
    }
}

#[test]
fn the_distance_is_that_of_the_nearest_disc_of_all_vessels() {
    for seed in 0..4 {
        let scene = random_tree(seed, 3, 5, 9.0, 20.0).unwrap();
        let camera = view([0.4, 1.0, -0.3], [37, 29], 1.7);
        let found = shares(&scene, &camera, &with_focus(1.0, 12.0));
        for (n, found) in found.iter().enumerate() {
            let place = DVec2::new(camera.view_x(n % 37), camera.view_y(n / 37));
            let expected = share(beyond_discs(&scene, &camera, place), 1.0, 12.0);
            assert!(
                (f64::from(*found) - expected).abs() < 1e-3,
                "seed {seed}, pixel {n}: {found}, {expected}"
            );
        }
    }
}

#[test]
fn neighbours_differ_by_no_more_than_the_slope_of_the_fade_allows() {
    // A vessel that widens fast: the distance from the wall at the nearest centerline point would be steeper.
    let points = vec![DVec3::ZERO, DVec3::new(6.0, 30.0, 0.0), DVec3::new(9.0, 31.0, 14.0)];
    let widening = Vessel::new(points, Some(vec![1.0, 6.5, 2.0])).unwrap();
    let scenes = [random_tree(7, 6, 20, 6.0, 30.0).unwrap(), tree(vec![widening])];
    for (scene, fade) in scenes.iter().zip([6.0, 3.0]) {
        let (camera, spacing) = (view([0.2, 1.0, 0.5], [131, 97], 0.6), 0.6);
        let found = shares(scene, &camera, &with_focus(2.0, fade));
        assert!(found.contains(&1.0) && found.contains(&0.0), "the fade shows");
        let most = (1.5 * spacing / fade) as f32 + 1e-5;
        for n in 0..found.len() - 131 {
            let apart = [n + 1, n + 131].map(|other| (found[n] - found[other]).abs());
            assert!(n % 131 == 130 || apart[0] <= most, "{} beside pixel {n}", apart[0]);
            assert!(apart[1] <= most, "{} below pixel {n}", apart[1]);
        }
    }
}

#[test]
fn all_instruction_sets_give_the_same_bits() {
    let scene = Scene::default().with_tree(random_tree(3, 40, 30, 4.0, 60.0).unwrap());
    let camera = view([0.1, 0.9, 0.3], [203, 111], 0.7);
    let all =
        Isa::available().into_iter().map(|isa| framed(&scene, &camera, &with_focus(1.0, 4.0), isa).focus);
    let bits: Vec<Vec<_>> =
        all.map(|focus| focus.as_flattened().iter().map(|share| share.to_bits()).collect()).collect();
    assert!(bits.iter().all(|one| one == &bits[0]));
}

#[test]
fn fades_are_two_pixels_wide_at_least_and_an_edge_without_one_is_hard() {
    let tube = tree(vec![vessel(&[[-100.0, 0.0, 0.0], [100.0, 0.0, 0.0]], 4.0)]);
    let camera = front([8, 96], 1.0);
    let faint = |fade: f64| {
        let found = shares(&tube, &camera, &with_focus(2.25, fade));
        found.iter().filter(|share| **share > 0.0 && **share < 1.0).count() / 8
    };
    assert_eq!((faint(0.0), faint(0.01), faint(6.0)), (0, 4, 12));
}

#[test]
fn a_vessel_along_the_view_counts_its_disc() {
    let along = tree(vec![vessel(&[[0.0, -30.0, 0.0], [0.0, 30.0, 0.0]], 5.0)]);
    let camera = front([41, 41], 1.0);
    let found = shares(&along, &camera, &with_focus(0.0, 0.0));
    for (n, share) in found.iter().enumerate() {
        let inside = camera.view_x(n % 41).hypot(camera.view_y(n / 41)) <= 5.0;
        assert_eq!(*share, if inside { 1.0 } else { 0.0 }, "pixel {n}");
    }
}

#[test]
fn within_the_margin_the_picture_is_plain_csr_to_the_bit() {
    let camera = front([120, 90], 0.8);
    for base in [Settings::default(), Settings::paper()] {
        for opacity in [None, Some(Opacity { transparent: 0.0, opaque: 400.0 })] {
            let plain = Settings { opacity, ..base.clone() };
            let focused = Settings { focus: Some(Focus { margin: 3.0, fade: 5.0 }), ..plain.clone() };
            let phantom = crossing().unwrap();
            let [csr, found] = [&plain, &focused].map(|settings| shown(&phantom, &camera, settings));
            let whole = (0..found.image.len()).filter(|n| found.focus[*n][0] == 1.0);
            assert!(whole.clone().count() > 500);
            assert!(whole.clone().all(|n| found.image[n] == csr.image[n]));
            assert!(of_surface(&found).contains(&0.0), "the picture reaches beyond the focus");
        }
    }
}

#[test]
fn a_margin_beyond_the_picture_is_csr() {
    let phantom = y_junction().unwrap();
    let camera = view([0.3, 1.0, 0.2], [90, 70], 1.1);
    for mode in [ContextMode::Blend { gamma: 0.0 }, ContextMode::Average] {
        let context = Some(Context { mode, from: mode.default_from(), ..Context::default() });
        let plain = Settings { context, ..Settings::default() };
        let beyond = Settings { focus: Some(Focus { margin: 1e6, fade: 6.0 }), ..plain.clone() };
        let [csr, found] = [&plain, &beyond].map(|settings| shown(&phantom, &camera, settings));
        assert_eq!(found.image, csr.image);
        assert_eq!(found.context, csr.context);
    }
}

#[test]
fn a_margin_far_below_zero_is_the_context() {
    let phantom = y_junction().unwrap();
    let camera = view([0.3, 1.0, 0.2], [90, 70], 1.1);
    for (from, strength) in [(ContextFrom::Whole, 1.0), (ContextFrom::Whole, 0.65), (ContextFrom::Cut, 1.0)] {
        let context = Some(Context { from, strength, ..Context::default() });
        let without = Settings { context, ..Settings::default() };
        let focused = Settings { focus: Some(Focus { margin: -1e6, fade: 6.0 }), ..without.clone() };
        let found = shown(&phantom, &camera, &focused);
        let expected = match from {
            ContextFrom::Whole => {
                context_alone(phantom.volume().unwrap(), &camera, &without, &|| false).unwrap()
            }
            ContextFrom::Cut => {
                let transparent = Some(Opacity { transparent: 1e11, opaque: 1e12 });
                shown(&phantom, &camera, &Settings { opacity: transparent, silhouettes: false, ..without })
            }
        };
        assert_eq!(found.image, expected.image, "from {from:?}, strength {strength}");
        assert_eq!(found.context, expected.context);
    }
}

#[test]
fn between_them_it_is_a_mean_by_the_share() {
    let phantom = y_junction().unwrap();
    let camera = front([90, 70], 0.9);
    let context = Some(Context { from: ContextFrom::Whole, strength: 0.5, ..Context::default() });
    let plain = Settings { silhouettes: false, context, ..Settings::default() };
    let focused = Settings { focus: Some(Focus { margin: 1.0, fade: 12.0 }), ..plain.clone() };
    let (csr, found) = (shown(&phantom, &camera, &plain), shown(&phantom, &camera, &focused));
    let behind = context_alone(phantom.volume().unwrap(), &camera, &plain, &|| false).unwrap();
    for n in (0..found.image.len()).filter(|n| !csr.value[*n].is_nan()) {
        let share = f64::from(found.focus[n][0]);
        for c in 0..3 {
            let [cut, context] = [&csr, &behind].map(|frame| f64::from(frame.image[n][c]));
            let expected = share * cut + (1.0 - share) * context;
            assert!((f64::from(found.image[n][c]) - expected).abs() <= 1.01, "pixel {n}, channel {c}");
        }
    }
}

/// The factor of a halo that darkens by 60 %, with constants in mm as in the documentation.
fn halo(beyond: f64, share: f64) -> f64 {
    1.0 - 0.6 * (1.0 - share) * (-(beyond - 6.0).max(0.0) / 6.0).exp()
}

fn around_the_cut(strength: f64, from: ContextFrom) -> Settings {
    let mode = ContextMode::Average;
    let context = Context { mode, from, halo: strength, ..Context::default() };
    Settings { context: Some(context), ..with_focus(1.0, 12.0) }
}

#[test]
fn beside_one_tube_the_halo_is_the_closed_form() {
    let tube = tree(vec![vessel(&[[-100.0, 3.0, 0.0], [100.0, -2.0, 0.0]], 4.0)]);
    let camera = front([9, 200], 0.5);
    let scene = Scene::default().with_tree(tube);
    let frame = framed(&scene, &camera, &around_the_cut(0.6, ContextFrom::Cut), Isa::widest());
    let factors: Vec<f32> = frame.focus.iter().map(|shares| shares[2]).collect();
    for row in 0..200 {
        let y = camera.view_y(row);
        let beyond = (y.abs() - 4.0).max(0.0);
        let expected = if beyond < 42.0 { halo(beyond, share(beyond, 1.0, 12.0)) } else { 1.0 };
        assert!((f64::from(at(&frame, &factors, 0.25, y)) - expected).abs() < 1e-5, "at {y} mm");
    }
}

#[test]
fn in_a_preview_the_halo_ends_without_a_step() {
    let tube = tree(vec![vessel(&[[-100.0, 3.0, 0.0], [100.0, -2.0, 0.0]], 4.0)]);
    let scene = Scene::default().with_tree(tube);
    let mut settings = around_the_cut(0.6, ContextFrom::Cut);
    settings.context.as_mut().unwrap().preview = true;
    let frame = framed(&scene, &front([3, 200], 0.5), &settings, Isa::widest());
    let factors: Vec<f32> = frame.focus.chunks(3).map(|row| row[0][2]).collect();
    assert!(factors.windows(2).all(|pair| (pair[0] - pair[1]).abs() < 0.06));
    assert!(factors[..48].iter().all(|factor| *factor == 1.0), "20 mm from the wall");
}

#[test]
fn a_halo_darkens_the_context_alone() {
    let phantom = y_junction().unwrap();
    let camera = view([0.3, 1.0, 0.2], [120, 90], 0.9);
    let [plain, found] =
        [0.0, 0.6].map(|halo| shown(&phantom, &camera, &around_the_cut(halo, ContextFrom::Whole)));
    let mut darkened = 0;
    for n in 0..plain.image.len() {
        let [share, _, factor, shade] = found.focus[n];
        assert_eq!((plain.focus[n], shade), ([share, plain.focus[n][1], 1.0, 0.0], 0.0));
        if share == 1.0 {
            assert_eq!(found.image[n], plain.image[n], "lumen and wall at pixel {n}");
        } else if share == 0.0 {
            for c in 0..3 {
                let [before, after] = [&plain, &found].map(|frame| f32::from(frame.image[n][c]));
                assert!((after - factor * before).abs() <= 1.01, "pixel {n}, channel {c}");
                darkened += usize::from(after < before);
            }
        }
    }
    assert!(darkened > 500, "{darkened} darker channels");
    assert_eq!((plain.depth(), &plain.value.len()), (found.depth(), &found.value.len()));
    assert_eq!(plain.context, found.context);
}

#[test]
fn far_from_all_walls_silhouettes_are_gone_and_near_them_they_are_as_before() {
    let phantom = crossing().unwrap();
    // In this view, lines between zones reach the border of the picture.
    let camera = view([0.2, 1.0, 0.3], [220, 180], 0.6);
    for base in [Settings::default(), Settings::paper()] {
        let quiet = Settings { silhouette_reach: Some(4.0), ..base.clone() };
        let none = Settings { silhouettes: false, ..base.clone() };
        let [all, found, without] = [&base, &quiet, &none].map(|settings| shown(&phantom, &camera, settings));
        let (mut near, mut far) = (0, 0);
        for n in 0..found.image.len() {
            match found.focus[n] {
                [surface, 1.0, ..] => {
                    assert_eq!((surface, found.image[n]), (1.0, all.image[n]));
                    near += usize::from(all.image[n] != without.image[n]);
                }
                [_, 0.0, ..] => {
                    assert_eq!(found.image[n], without.image[n]);
                    far += usize::from(all.image[n] != without.image[n]);
                }
                _ => {}
            }
        }
        assert!(near > 10 && far > 10, "{near} pixels of lines near walls, {far} far away");
    }
}

#[test]
fn where_no_line_can_lie_the_picture_needs_no_distance() {
    // Only a picture requested together with its shares has exact shares everywhere.
    let whole = ImageSet::ALL.and(ImageSet::of(&[Image::Focus]));
    let settings = |reach: f64, focus: Option<Focus>, first: &[usize]| Settings {
        silhouette_reach: Some(reach),
        focus,
        focus_vessels: first.to_vec(),
        ..Settings::default()
    };
    let focus = Some(Focus { margin: 1.0, fade: 3.0 });
    let all = [
        settings(4.0, None, &[]),
        settings(0.5, None, &[1]),
        settings(4.0, focus, &[]),
        settings(12.0, focus, &[0]),
        Settings { silhouette_rule: SilhouetteRule::Gradient, ..settings(4.0, None, &[]) },
    ];
    let phantom = crossing().unwrap();
    let volume = phantom.volume().unwrap();
    for tree in [phantom.tree.clone(), random_tree(5, 9, 20, 3.0, 40.0).unwrap()] {
        let scene = Scene::new(volume, tree);
        for (camera, settings) in [([221, 183], 0.6), ([70, 40], 2.0), ([17, 9], 6.0)]
            .map(|(size, spacing)| view([0.2, 1.0, 0.3], size, spacing))
            .iter()
            .flat_map(|camera| all.iter().map(move |settings| (camera, settings)))
        {
            let [expected, found] = [whole, ImageSet::ALL].map(|images| {
                let request = Request { images, ..Request::new(camera, settings) };
                CpuRenderer::default().render(&scene, &request).unwrap()
            });
            assert_eq!(expected.image, found.image, "{:?}, {settings:?}", camera.size());
        }
    }
}

#[test]
fn a_focus_needs_vessels_and_finite_lengths() {
    let phantom = y_junction().unwrap();
    let camera = front([9, 9], 1.0);
    let refused =
        context_alone(phantom.volume().unwrap(), &camera, &with_focus(2.0, 6.0), &|| false).unwrap_err();
    assert_eq!((refused.kind, refused.subject.as_str()), (ErrorKind::Settings, "focus"));
    for (margin, fade, subject) in [
        (f64::NAN, 6.0, "focus margin"),
        (f64::INFINITY, 6.0, "focus margin"),
        (2.0, -1.0, "focus fade"),
        (2.0, f64::NAN, "focus fade"),
    ] {
        assert_eq!(with_focus(margin, fade).check().unwrap_err().subject, subject);
    }
}
