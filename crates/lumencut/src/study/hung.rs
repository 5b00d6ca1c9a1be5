//! Directions in the picture of a section: as radiologists hang axial and coronal slices.

use glam::{DQuat, DVec3};

/// The side from which a section is seen: from the feet; one across a horizontal vessel from the front.
const SEEN_ALONG: DVec3 = DVec3::new(0.1, 0.2, 1.0);

/// Unit vectors (LPS) that point right and down: the axes of an axial slice (left, posterior), turned into the section by the
/// smallest rotation.
pub(crate) fn hung(normal: DVec3) -> [DVec3; 2] {
    let along = if normal.dot(SEEN_ALONG) < 0.0 { -normal } else { normal };
    let turn = DQuat::from_rotation_arc(DVec3::Z, along);
    [turn * DVec3::X, turn * DVec3::Y]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axial_and_coronal_sections_hang_as_radiologists_expect() {
        for normal in [DVec3::Z, DVec3::NEG_Z] {
            assert_eq!(hung(normal), [DVec3::X, DVec3::Y], "anterior is up, the patient's right on the left");
        }
        for normal in [DVec3::Y, DVec3::NEG_Y] {
            let [right, down] = hung(normal);
            assert!(
                right.distance(DVec3::X) < 1e-12 && down.distance(DVec3::NEG_Z) < 1e-12,
                "superior is up"
            );
        }
    }

    #[test]
    fn along_a_vessel_the_picture_turns_without_jumps() {
        let normal = |n: i32| DVec3::new(f64::from(n) * 0.01, 0.3, 1.0).normalize();
        for n in -60..60 {
            let [one, next] = [n, n + 1].map(|n| hung(normal(n)));
            assert!(one[0].distance(next[0]) < 0.02 && one[1].distance(next[1]) < 0.02);
            assert!(one[0].dot(one[1]).abs() < 1e-12 && one[0].dot(normal(n)).abs() < 1e-12);
            assert!(one[0].x > 0.0 && one[1].y > 0.0);
        }
    }
}
