use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::*;
use crate::math::centerline_path::CenterlinePath;
use crate::reformations::Wall;
use crate::reformations::cpr::{Straightened, View};
use crate::stop::NEVER;
use crate::vessel_tree::Vessel;

const FRONT: View = View { up: DVec3::Z, angle: 0.0, normal: None };
const DIRECTIONS: usize = 360;
const BOUNDS: Bounds = Bounds { level: 150.0, calcium: 450.0, is_bright: true };

/// A vessel with a wall at `radius` (arc length, direction), which is open where `open` says so.
struct Scene {
    path: Arc<CenterlinePath>,
    straightened: Straightened,
    tube: Arc<Tube>,
}

fn scene(points: &[DVec3], radius: impl Fn(f64, f64) -> f64, open: impl Fn(f64, f64) -> bool) -> Scene {
    let path = Arc::new(CenterlinePath::new(&Vessel::new(points.to_vec(), None).unwrap(), 0.0).unwrap());
    let straightened = Straightened::new(Arc::clone(&path), &FRONT).unwrap();
    let at: Vec<f64> = (0..=(2.0 * path.length()) as usize).map(|n| n as f64 / 2.0).collect();
    let each = |n: usize| (at[n / DIRECTIONS], TAU * (n % DIRECTIONS) as f64 / DIRECTIONS as f64);
    let count = at.len() * DIRECTIONS;
    let radii = (0..count).map(|n| radius(each(n).0, each(n).1)).collect();
    let opens = (0..count).map(|n| open(each(n).0, each(n).1)).collect();
    let wall = Wall::new(at.clone(), radii, opens).unwrap();
    let tube = Arc::new(tube(&straightened, &wall, |_| BOUNDS));
    Scene { path, straightened, tube }
}

fn line(length: f64) -> Vec<DVec3> {
    vec![DVec3::new(1.0, 2.0, length), DVec3::new(1.0, 2.0, 0.0)]
}

impl Scene {
    fn seen(
        &self,
        [at, radius, roll]: [f64; 3],
        image: LensImage,
        value: &(dyn Fn(DVec3) -> f32 + Sync),
    ) -> Endoscopy {
        let eye = Eye::new([&self.path; 2], &self.straightened, [at, radius, roll], false).unwrap();
        let beyond = Beyond { value, step: 0.25 };
        Endoscopy::new(Arc::clone(&self.tube), eye, image, (&beyond, NEVER)).unwrap()
    }
}

fn image(lens: Lens, degrees: f64) -> LensImage {
    LensImage::new(lens, [65, 49], degrees.to_radians()).unwrap()
}

/// Angle of a pixel's ray from the middle of the image.
fn angle(made: &Endoscopy, n: usize) -> f64 {
    made.eye().axes[2].angle_between(made.point(n) - made.eye().position)
}

#[test]
fn a_tube_is_met_at_its_radius_by_the_sine() {
    let scene = scene(&line(300.0), |_, _| 6.0, |_, _| false);
    for image in [image(Lens::Perspective, 100.0), image(Lens::Fisheye, 180.0)] {
        let made = scene.seen([50.0, 6.0, 0.0], image, &|_| f32::NAN);
        let mut seen = 0;
        for (n, away) in made.depth().iter().enumerate() {
            if away.is_finite() {
                let expected = 6.0 / angle(&made, n).sin();
                assert!((f64::from(*away) - expected).abs() < 0.01, "{n}: {away} instead of {expected}");
                seen += 1;
            }
        }
        assert!(seen > 1500, "{seen} pixels");
        let [radius, at] = [made.radius(NEVER).unwrap(), made.arc_length(NEVER).unwrap()];
        for n in (0..radius.len()).filter(|n| made.depth()[*n].is_finite()) {
            assert!((radius[n] - 6.0).abs() < 1e-3);
            let ahead = f64::from(made.depth()[n]) * angle(&made, n).cos();
            assert!((at[n] - 50.0 - ahead).abs() < 1e-3, "{n}: {} instead of {}", at[n], 50.0 + ahead);
        }
    }
}

#[test]
fn a_cone_and_a_bend_are_met_at_their_roots() {
    let cone = scene(&line(100.0), |at, _| 4.0 + 0.05 * at, |_, _| false);
    let made = cone.seen([20.0, 5.0, 0.0], image(Lens::Fisheye, 170.0), &|_| f32::NAN);
    for (n, away) in made.depth().iter().enumerate().filter(|(_, away)| away.is_finite()) {
        let (sine, cosine) = angle(&made, n).sin_cos();
        let expected = 5.0 / (sine - 0.05 * cosine);
        // Rows of the tables lie half a mm apart.
        assert!((f64::from(*away) - expected).abs() < 0.01 * expected, "{n}: {away}, {expected}");
    }
    let turns = (0..=1440).map(|n| PI * f64::from(n) / 1440.0);
    let bend: Vec<_> = turns.map(|t| DVec3::new(t.cos(), 0.0, t.sin()) * 40.0).collect();
    let torus = scene(&bend, |_, _| 8.0, |_, _| false);
    let made = torus.seen([60.0, 8.0, 0.0], image(Lens::Perspective, 100.0), &|_| f32::NAN);
    let from_wall = |point: DVec3| (DVec2::new(point.x, point.z).length() - 40.0).hypot(point.y) - 8.0;
    for n in (0..65 * 49).filter(|n| made.depth()[*n].is_finite()) {
        assert!(from_wall(made.point(n)).abs() < 0.02, "{n}: {}", from_wall(made.point(n)));
        let before = made.eye().position.lerp(made.point(n), 0.98);
        assert!(from_wall(before) < 0.0);
    }
}

#[test]
fn pixels_and_places_return() {
    let scene = scene(&line(200.0), |_, around| 6.0 + (3.0 * around).cos(), |_, _| false);
    for image in [image(Lens::Perspective, 120.0), image(Lens::Fisheye, 180.0), image(Lens::Fisheye, 300.0)] {
        let made = scene.seen([80.0, 6.0, 0.4], image, &|_| f32::NAN);
        let position = made.curved(NEVER).unwrap();
        for (n, point) in position.position().iter().enumerate().filter(|(_, point)| point.is_finite()) {
            let pixel = DVec2::new((n % 65) as f64, (n / 65) as f64);
            assert!(made.pixel_from_world(*point).distance(pixel) < 1e-9, "{pixel}");
            let between = pixel + DVec2::new(0.3, -0.2);
            let world = made.world_from_pixel(between);
            assert!(!world.is_finite() || made.pixel_from_world(world).distance(between) < 1e-9, "{between}");
            let hidden = made.eye().position.lerp(*point, 1.5);
            assert!(made.pixel_from_world(hidden).is_nan());
        }
        assert!(made.world_from_pixel(DVec2::new(65.0, 10.0)).is_nan());
    }
}

#[test]
fn roll_turns_the_image_and_the_eye_is_on_the_centerline() {
    let scene = scene(&line(100.0), |_, around| 6.0 + around.cos(), |_, _| false);
    let square = || LensImage::new(Lens::Perspective, [41, 41], 1.5).unwrap();
    let [upright, turned] =
        [0.0, FRAC_PI_2].map(|roll| scene.seen([30.0, 6.0, roll], square(), &|_| f32::NAN));
    assert!(upright.eye().position.distance(DVec3::new(1.0, 2.0, 70.0)) < 1e-9);
    for n in 0..41 * 41 {
        let (i, j) = (n % 41, n / 41);
        // The picture turns clockwise.
        let (a, b) = (upright.depth()[n], turned.depth()[i * 41 + 40 - j]);
        assert!((a - b).abs() < 0.01 * a || (a.is_nan() && b.is_nan()), "{i}, {j}: {a} and {b}");
    }
}

#[test]
fn a_ray_through_an_opening_goes_on_to_the_end_of_the_lumen() {
    // A branch of radius 2 mm along x, 20 mm ahead of the eye, which ends after 25 mm.
    let around = |around: f64| around.cos() > 0.8;
    let scene = scene(&line(100.0), |_, _| 5.0, |at, towards| (at - 50.0).abs() < 3.0 && around(towards));
    let value = |p: DVec3| {
        let away = (p.y - 2.0).hypot(p.z - 50.0);
        let is_inside = away < 2.0 && p.x < 26.0;
        if is_inside { 300.0 } else { 0.0 }
    };
    let made = scene.seen([50.0, 5.0, 0.0], image(Lens::Fisheye, 200.0), &value);
    let target = made.pixel_from_world(DVec3::new(20.0, 2.0, 50.0));
    let n = target.y.round() as usize * 65 + target.x.round() as usize;
    assert!(made.open()[n] && made.depth()[n] > 10.0, "{}", made.depth()[n]);
    assert!(made.arc_length(NEVER).unwrap()[n].is_nan());
    let shades = made.shades(&Beyond { value: &value, step: 0.25 }, NEVER).unwrap();
    assert!(shades.iter().all(|shade| shade.is_nan() || (0.0..=1.0).contains(shade)));
    // Calcium in the mouth closes it.
    let closed = scene.seen([50.0, 5.0, 0.0], image(Lens::Fisheye, 200.0), &|_| 900.0);
    assert!((f64::from(closed.depth()[n]) - 5.0).abs() < 0.3, "{}", closed.depth()[n]);
}

#[test]
fn wrong_lenses_and_places_are_rejected() {
    let scene = scene(&line(50.0), |_, _| 5.0, |_, _| false);
    for at in [-0.1, 50.1, f64::NAN] {
        let error = Eye::new([&scene.path; 2], &scene.straightened, [at, 5.0, 0.0], false).unwrap_err();
        assert!(error.to_string().contains("0 to 50.0000 mm"), "{error}");
    }
    assert!(Eye::new([&scene.path; 2], &scene.straightened, [9.0, 5.0, f64::NAN], false).is_err());
    for (lens, wide) in
        [(Lens::Perspective, 3.0), (Lens::Fisheye, 6.3), (Lens::Fisheye, 0.0), (Lens::Fisheye, f64::NAN)]
    {
        assert!(LensImage::new(lens, [9, 9], wide).is_err(), "{wide}");
    }
    assert!(LensImage::new(Lens::Fisheye, [0, 9], 1.0).is_err());
}
