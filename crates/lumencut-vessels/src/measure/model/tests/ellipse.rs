use super::*;

const BLUR: [f64; 3] = [0.16, 0.03, 0.09];

fn whitening() -> Whitening {
    let [xx, xy, yy] = BLUR;
    Whitening::new(DMat2::from_cols_array(&[xx, xy, xy, yy]))
}

fn tilted() -> Ellipse {
    Ellipse { center: DVec2::new(0.3, -0.2), mean: 1.1, stretch: DVec2::new(0.25, 0.3) }
}

fn by_area(ellipse: &Ellipse, place: DVec2) -> f64 {
    let [xx, xy, yy] = BLUR;
    let determinant = xx * yy - xy * xy;
    let within = ellipse.matrix().inverse();
    let step = 0.004;
    let mut sum = 0.0;
    for j in -500..500 {
        for i in -500..500 {
            let point = ellipse.center + DVec2::new(f64::from(i) + 0.5, f64::from(j) + 0.5) * step;
            if (within * (point - ellipse.center)).length_squared() <= 1.0 {
                let d = point - place;
                let square = (yy * d.x * d.x - 2.0 * xy * d.x * d.y + xx * d.y * d.y) / determinant;
                sum += (-0.5 * square).exp();
            }
        }
    }
    sum * step * step / (TAU * determinant.sqrt())
}

#[test]
fn the_boundary_gives_what_the_area_does() {
    let ellipse = tilted();
    let boundary = Boundary::new(&ellipse, whitening());
    for place in [[0.3, -0.2], [1.2, 0.4], [0.0, 0.9], [-1.4, -1.0], [2.5, 2.0]] {
        let place = DVec2::from_array(place);
        let (value, expected) = (boundary.value(place), by_area(&ellipse, place));
        assert!((value - expected).abs() < 3e-4, "{place}: {value} instead of {expected}");
    }
}

#[test]
fn a_circle_has_its_closed_form_in_the_middle() {
    let round = Whitening::new(DMat2::from_diagonal(DVec2::splat(0.25)));
    for radius in [0.1, 0.5, 1.7, 12.0, 39.0] {
        let value = Boundary::new(&Ellipse::circle(DVec2::ZERO, radius), round).value(DVec2::ZERO);
        let expected = 1.0 - (-radius * radius / 0.5).exp();
        assert!((value - expected).abs() < 1e-5, "{radius}: {value} instead of {expected}");
    }
}

#[test]
fn derivatives_are_those_of_the_value() {
    let ellipse = tilted();
    let (x, y) = ([1.25; FAN], [0.45; FAN]);
    let slopes = Boundary::new(&ellipse, whitening()).blurred(&x, &y).slopes;
    for parameter in 0..SHAPE {
        let step = 0.02;
        let [low, high] = [-step, step].map(|by| {
            let mut moved = ellipse.parameters();
            moved[parameter] += by;
            let moved = Ellipse::from_parameters(&moved).unwrap();
            f64::from(Boundary::new(&moved, whitening()).blurred(&x, &y).value[0])
        });
        let expected = (high - low) / (2.0 * step);
        let slope = f64::from(slopes[parameter][0]);
        assert!((slope - expected).abs() < 2e-3, "{parameter}: {slope} instead of {expected}");
    }
}

#[test]
fn axes_area_and_radii_belong_together() {
    let ellipse = Ellipse { center: DVec2::ZERO, mean: 3.0, stretch: DVec2::new(1.0, 0.0) };
    assert_eq!(ellipse.semi_axes(), [2.0, 4.0]);
    assert!((ellipse.area() - 8.0 * PI).abs() < 1e-12);
    assert!((ellipse.equivalent_diameter() - 32.0_f64.sqrt()).abs() < 1e-12);
    assert!((ellipse.radius_towards(DVec2::X) - 4.0).abs() < 1e-12);
    assert!((ellipse.radius_towards(DVec2::Y) - 2.0).abs() < 1e-12);
    assert!(Ellipse::from_parameters(&[0.0, 0.0, 1.0, 1.0, 0.1]).is_none());
    let again = Ellipse::from_parameters(&tilted().parameters()).unwrap();
    assert_eq!(again, tilted());
}

#[test]
fn all_instruction_sets_give_the_same() {
    use lumencut_core::math::lanes::{Isa, Kernel, dispatch};
    struct At<'a>(&'a Boundary);
    impl Kernel for At<'_> {
        type Output = [f32; FAN];
        #[inline(always)]
        fn run(self) -> [f32; FAN] {
            let x = std::array::from_fn(|n| n as f32 * 0.2 - 1.5);
            self.0.blurred(&x, &[0.3; FAN]).value
        }
    }
    let boundary = Boundary::new(&tilted(), whitening());
    let all: Vec<_> = Isa::available().into_iter().map(|isa| dispatch(isa, At(&boundary))).collect();
    assert!(all.iter().all(|values| values == &all[0]));
}

#[test]
fn the_exponential_is_near_enough() {
    for n in 0..800 {
        let x = -f64::from(n) * 0.05;
        let (value, expected) = (f64::from(exponential(x as f32)), f64::from(x as f32).exp());
        assert!((value - expected).abs() <= 4e-6 * expected + 1e-30, "{x}: {value} instead of {expected}");
    }
}

#[test]
fn half_axes_end_where_the_boundary_is_nearest_and_farthest() {
    let ellipse = tilted();
    let [short, long] = ellipse.half_axes();
    assert!(short.dot(long).abs() < 1e-12);
    for axis in [short, long] {
        assert!((ellipse.radius_towards(axis.normalize()) - axis.length()).abs() < 1e-12);
    }
    for n in 0..36 {
        let radius = ellipse.radius_towards(DVec2::from_angle(f64::from(n) * 0.1));
        assert!((short.length()..=long.length()).contains(&radius));
    }
    let [across, along] = Ellipse::circle(DVec2::ZERO, 2.0).half_axes();
    assert!((across.length() - 2.0).abs() < 1e-12 && (along.length() - 2.0).abs() < 1e-12);
}

#[test]
fn nodes_far_away_count_as_much_as_those_of_one_place_alone() {
    // Sixteen points near one side of a wide lumen and far from its other side.
    let boundary = Boundary::new(&Ellipse::circle(DVec2::ZERO, 9.0), whitening());
    let x: [f32; FAN] = std::array::from_fn(|n| 8.0 + 0.15 * n as f32);
    let together = boundary.blurred(&x, &[0.2; FAN]);
    for l in 0..FAN {
        let mut beside = x;
        beside[(l + 1) % FAN] = -9.0;
        let apart = boundary.blurred(&beside, &[0.2; FAN]);
        assert_eq!(together.value[l], apart.value[l]);
        for (slope, slopes) in together.slopes.iter().zip(&apart.slopes) {
            assert!((slope[l] - slopes[l]).abs() < 1e-12, "{} {}", slope[l], slopes[l]);
        }
    }
}
