//! Bitwise comparison of cut surfaces.

use lumencut_core::frame::Frame;

/// The number of pixels that differ in any bit of depth, vessel or distance.
pub fn different_pixels(a: &Frame, b: &Frame) -> usize {
    let sizes = |frame: &Frame| [frame.depth().len(), frame.distance.len(), frame.vessel.len()];
    assert_eq!(sizes(a), sizes(b), "different sizes");
    assert!(!a.depth().is_empty(), "nothing to compare");
    let is_same = |a: &[f32], b: &[f32], p: usize| a[p].to_bits() == b[p].to_bits();
    let differs = |p: &usize| {
        !is_same(a.depth(), b.depth(), *p)
            || !is_same(&a.distance, &b.distance, *p)
            || a.vessel[*p] != b.vessel[*p]
    };
    (0..a.depth().len()).filter(differs).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brute_force::by_hierarchy;
    use crate::pictures::depth_of;
    use crate::settings::unfiltered;
    use crate::trees::trefoil;
    use crate::views::front;

    #[test]
    fn a_changed_bit_is_seen_in_each_image() {
        let cut = || by_hierarchy(&trefoil(40), &front([24, 20], 6.0), &unfiltered());
        let (a, mut b) = (cut(), cut());
        assert_eq!(different_pixels(&a, &b), 0);
        depth_of(&mut b)[0] = f32::from_bits(a.depth()[0].to_bits() ^ 1);
        assert_eq!(different_pixels(&a, &b), 1);
        b.distance[1] = f32::NAN;
        b.vessel[2] += 1;
        assert_eq!((different_pixels(&a, &b), different_pixels(&b, &a)), (3, 3));
    }
}
