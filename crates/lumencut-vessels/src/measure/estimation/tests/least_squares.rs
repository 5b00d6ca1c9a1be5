use super::*;

/// y = a exp(-b x): sum of squares and derivatives.
fn decay(at: &[f64; 2]) -> Option<Normal<2>> {
    let [a, b] = *at;
    if a <= 0.0 {
        return None;
    }
    let mut normal = Normal::zero();
    for n in 0..20 {
        let x = f64::from(n) * 0.2;
        let bell = (-b * x).exp();
        let missing = 3.0 * (-0.7 * x).exp() - a * bell;
        let by = [bell, -a * x * bell];
        normal.cost += missing * missing;
        for i in 0..2 {
            normal.slope[i] += by[i] * missing;
            for j in 0..2 {
                normal.matrix[i][j] += by[i] * by[j];
            }
        }
    }
    Some(normal)
}

#[test]
fn the_least_sum_is_found() {
    let found = minimum([1.0, 3.0], 50, decay).unwrap();
    assert!((found.at[0] - 3.0).abs() < 1e-4 && (found.at[1] - 0.7).abs() < 1e-4, "{:?}", found.at);
    assert!(found.normal.cost < 1e-8);
}

#[test]
fn what_is_not_allowed_is_no_start() {
    assert!(minimum([-1.0, 1.0], 10, decay).is_none());
}

#[test]
fn what_is_expected_pulls_by_its_weight() {
    // 4 (x - 1)² + 4 (x - 6)² has its minimum midway between 1 and 6.
    let found = minimum([0.0], 20, |[x]: &[f64; 1]| {
        let mut normal = Normal::zero();
        normal.expect(&[1.0], 1.0 - x, 0.5);
        normal.expect(&[1.0], 6.0 - x, 0.5);
        Some(normal)
    });
    assert!((found.unwrap().at[0] - 3.5).abs() < 1e-6);
}

#[test]
fn systems_are_solved_and_singular_ones_refused() {
    let matrix = [[4.0, 1.0, 0.5], [1.0, 3.0, -1.0], [0.5, -1.0, 2.0]];
    let right = [1.0, -2.0, 0.5];
    let x = solved(&matrix, &right).unwrap();
    for i in 0..3 {
        let product: f64 = (0..3).map(|j| matrix[i][j] * x[j]).sum();
        assert!((product - right[i]).abs() < 1e-12);
    }
    assert!(solved(&[[1.0, 1.0], [1.0, 1.0]], &[1.0, 2.0]).is_none());
    assert!((variance(&[[4.0, 0.0], [0.0, 9.0]], &[1.0, 3.0]).unwrap() - 1.25).abs() < 1e-12);
}
