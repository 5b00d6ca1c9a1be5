use super::*;

const SIDE: usize = 2 * HALO + 3;

fn response(number: usize, value: impl Fn([f64; 3]) -> f32) -> (f32, [f64; 3]) {
    let middle = (SIDE / 2) as f64;
    let values = (0..SIDE * SIDE * SIDE)
        .map(|n| value([n % SIDE, n / SIDE % SIDE, n / (SIDE * SIDE)].map(|c| c as f64 - middle)))
        .collect();
    let radii = [(number, gains()[number].factor, 1e-3)];
    let found = FluxOf { values, size: [SIDE; 3], radii: &radii }.responses();
    let voxel = found.size.map(|n| n / 2);
    (found.strongest[found.number(voxel)], found.direction(voxel))
}

#[test]
fn a_cylinder_of_contrast_one_gives_one_whichever_way_it_runs() {
    for number in 0..RADII.len() {
        let along_z = response(number, |[x, y, _]| blurred_disc(x, y, RADII[number]));
        assert!((along_z.0 - 1.0).abs() < 1e-3, "{number}: {along_z:?}");
        assert!(along_z.1[2].abs() > 0.999, "{along_z:?}");
        // A tube parallel to the diagonal of x and y.
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let oblique = response(number, |[x, y, z]| blurred_disc((x - y) * half, z, RADII[number]));
        assert!((oblique.0 - 1.0).abs() < 0.1, "{number}: {oblique:?}");
        assert!((oblique.1[0] * oblique.1[1] - 0.5).abs() < 0.01, "{oblique:?}");
    }
}

#[test]
fn a_plate_a_slope_and_a_dark_cylinder_give_nothing() {
    for number in 0..RADII.len() {
        assert_eq!(response(number, |[x, _, _]| blurred_disc(x, 0.0, RADII[number])).0, 0.0);
        assert_eq!(response(number, |[x, y, z]| (x + 2.0 * y - z) as f32).0, 0.0);
        assert_eq!(response(number, |[x, y, _]| -blurred_disc(x, y, RADII[number])).0, 0.0);
    }
}

#[test]
fn eigenvalues_of_a_turned_diagonal_matrix_are_its_diagonal() {
    let [sin, cos] = [0.6_f32, 0.8];
    let (a, b, c) = (-3.0, 1.0, 2.0);
    // The tensor after a rotation about z.
    let flows =
        [a * cos * cos + b * sin * sin, a * sin * sin + b * cos * cos, c, (a - b) * sin * cos, 0.0, 0.0];
    let found = eigenvalues(flows);
    for (value, expected) in found.into_iter().zip([a, b, c]) {
        assert!((value - expected).abs() < 1e-5, "{found:?}");
    }
    assert!(along(flows, c)[2].abs() > 0.999_999);
}
