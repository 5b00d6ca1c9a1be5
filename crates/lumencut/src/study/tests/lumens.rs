//! Tests of the lumens under a pointer, with their sections.

use glam::DVec3;

use super::edits::bare;
use crate::study::lumens::PointedMessage;

#[test]
fn a_ray_across_a_vessel_and_a_place_in_it_mean_the_same_section() {
    let (study, lines) = bare("y_junction");
    let (middle, next) = (lines[0][lines[0].len() / 2], lines[0][lines[0].len() / 2 + 1]);
    let along = (next - middle).normalize();
    let ray = along.any_orthonormal_vector();
    let from = middle - ray * 30.0;
    let pointed = |point: DVec3, along: Option<DVec3>| PointedMessage {
        point: point.to_array(),
        along: along.map(|along| along.to_array()),
    };
    let met = study.lumens(&pointed(from, Some(ray))).expect("a volume");
    let one = met.iter().find(|one| DVec3::from_array(one.center).distance(middle) < 0.5).expect("the trunk");
    // The pointed place stays on the ray.
    assert!((DVec3::from_array(one.point) - from).cross(ray).length() < 1e-9);
    let [right, down] = [one.right, one.down].map(DVec3::from_array);
    assert!(right.cross(down).dot(along).abs() > 0.99 && right.dot(down).abs() < 1e-9);
    let beside = middle + ray * 0.15 * one.diameter;
    let at = study.lumens(&pointed(beside, None)).expect("a volume");
    assert_eq!(at.len(), 1);
    assert_eq!(at[0].point, beside.to_array());
    assert!((at[0].diameter - one.diameter).abs() < 0.3, "{at:?} {one:?}");
}
