use super::*;
use crate::measure::uncertainty::Parts;
use glam::DVec2;

fn fit(radius: f64, other: Option<Ellipse>) -> Option<Fit> {
    Some(Fit {
        ellipse: Ellipse::circle(DVec2::new(radius, 0.0), radius),
        lumen: [1.0, 0.01],
        background: 0.0,
        wall: None,
        missed: 0.1,
        uncertainty: f64::NAN,
        parts: Parts::unknown(),
        free: 1.0,
        other,
    })
}

fn sections(fits: Vec<Option<Fit>>) -> AllSections {
    let lumen = (0..fits.len()).map(|n| [1.0 + n as f64, 0.02]).collect();
    AllSections { fits, noise: 0.05, lumen, walls: None, texture: Texture::white() }
}

#[test]
fn a_section_between_two_that_were_fitted_has_the_lumen_between_theirs() {
    let other = Ellipse::circle(DVec2::ZERO, 3.0);
    let all = sections(vec![fit(2.0, None), fit(2.6, Some(other))]);
    let known = |n| all.known(n, 3, None).unwrap();
    for (n, radius) in [(0, 2.0), (1, 2.2), (2, 2.4), (3, 2.6), (4, 2.6)] {
        let (known, _) = known(n);
        assert!((known.ellipse.mean - radius).abs() < 1e-12, "{n}");
        assert!((known.ellipse.center.x - radius).abs() < 1e-12, "{n}");
    }
    let levels: Vec<f64> = (0..4).map(|n| known(n).0.lumen[0]).collect();
    assert_eq!(levels, [1.0, 1.0, 2.0, 2.0], "those of the nearest");
    let others: Vec<bool> = (0..4).map(|n| known(n).1.is_some()).collect();
    assert_eq!(others, [false, false, true, true]);
}

#[test]
fn a_section_beside_one_without_a_fit_begins_where_its_lumen_looked_to_be() {
    let all = sections(vec![fit(2.0, None), None]);
    assert!(all.known(1, 2, None).is_none());
    let estimate = Ellipse::circle(DVec2::ONE, 1.5);
    let (known, _) = all.known(1, 2, Some(estimate)).unwrap();
    assert_eq!(known.ellipse, estimate);
}
