//! Tests that references within one diameter of the stenosis are rejected.

use super::made_profile::profile;
use super::*;

/// A vessel of 40 mm that is 5 mm wide, but 3 mm wide from 19 to 21 mm.
fn narrowed() -> Profile {
    let width = |n: usize| if (38..=42).contains(&n) { 3.0 } else { 5.0 };
    profile(&(0..81).map(|n| [width(n), 0.1]).collect::<Vec<_>>())
}

fn graded(at: f64, method: Method, reference: &[f64]) -> Result<Stenosis> {
    let compared = Compared { reference: reference.to_vec(), original: Some(6.0), comparison: None };
    narrowed().stenosis(at, method, &compared)
}

#[test]
fn a_place_is_not_graded_against_itself() {
    for method in [Method::Nascet, Method::Area] {
        let refused = graded(30.0, method, &[30.0]).expect_err("a place graded against itself").to_string();
        assert!(refused.contains("30.0 mm, 0.0 mm from the stenosis at 30.0 mm"), "{refused}");
        assert!(refused.contains("at least one diameter of the vessel (5.00 mm) away"), "{refused}");
        assert!(refused.contains("farther from the stenosis"), "{refused}");
    }
}

#[test]
fn a_reference_lies_at_least_its_diameter_away() {
    for method in [Method::Nascet, Method::Area] {
        for near in [&[24.9][..], &[15.1], &[10.0, 24.9], &[15.1, 30.0]] {
            let refused = graded(20.0, method, near).expect_err("a reference too near");
            assert_eq!(refused.kind, ErrorKind::Measuring, "{near:?}");
            assert!(refused.to_string().contains("at least one diameter"), "{refused}");
        }
        for far in [&[25.0][..], &[15.0], &[15.0, 25.0]] {
            assert!(graded(20.0, method, far).is_ok(), "{far:?}");
        }
    }
}

#[test]
fn a_reference_that_is_not_used_may_lie_anywhere() {
    assert!(graded(20.0, Method::Ecst, &[20.0]).is_ok());
}
