//! Compares frames: bit by bit, or with differences by rounding allowed.

use lumencut_core::frame::Frame;

use crate::tolerances::{COLOR, COLOR_LEAP, DEPTH, MOST_TOGETHER, NEIGHBOURHOOD};

/// How two frames differ.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Differences {
    /// Fraction of pixels whose depths differ by more than [`DEPTH`].
    pub depths: f64,
    /// Largest difference in any colour channel of any pixel.
    pub largest_color: u8,
    /// Fraction of pixels that differ in a channel by more than [`COLOR`].
    pub colors: f64,
    /// Fraction of pixels that differ in a channel by more than [`COLOR_LEAP`].
    pub leaps: f64,
    pub vessels: usize,
    pub vessel_share: f64,
    /// The largest number of pixels in one 8 × 8 block that differ in depth or by [`COLOR_LEAP`].
    pub together: usize,
}

/// Checks that two images have the same size and separate memory, and are empty or have all pixels.
fn check<T>(name: &str, a: &[T], b: &[T], pixels: usize) {
    assert_eq!(a.len(), b.len(), "{name}: different sizes");
    assert!(a.is_empty() || a.len() == pixels, "{name}: {} of {pixels} pixels", a.len());
    assert!(a.is_empty() || a.as_ptr() != b.as_ptr(), "{name}: compared with itself");
}

/// The differences of two frames of one view.
pub fn compare(a: &Frame, b: &Frame) -> Differences {
    let [width, height] = a.size();
    let pixels = width * height;
    assert_eq!([width, height], b.size(), "different views");
    check("image", &a.image, &b.image, pixels);
    check("depth", a.depth(), b.depth(), pixels);
    check("vessel", &a.vessel, &b.vessel, pixels);
    assert!(!a.image.is_empty() || !a.depth().is_empty(), "nothing to compare");
    let mut found = Differences::default();
    let mut neighbourhoods = vec![0; width.div_ceil(NEIGHBOURHOOD) * height.div_ceil(NEIGHBOURHOOD)];
    let [mut depths, mut colors, mut leaps] = [0; 3];
    for p in 0..pixels {
        let other_depth = !a.depth().is_empty() && !DEPTH.is_same(a.depth()[p], b.depth()[p]);
        let channel = |c: usize| a.image[p][c].abs_diff(b.image[p][c]);
        let color = if a.image.is_empty() { 0 } else { (0..4).map(channel).max().unwrap_or(0) };
        found.largest_color = found.largest_color.max(color);
        found.vessels += usize::from(!a.vessel.is_empty() && a.vessel[p] != b.vessel[p]);
        depths += usize::from(other_depth);
        let (is_other, leaps_far) = (f32::from(color) > COLOR.apart, f32::from(color) > COLOR_LEAP.apart);
        colors += usize::from(is_other);
        leaps += usize::from(leaps_far);
        let place = p / width / NEIGHBOURHOOD * width.div_ceil(NEIGHBOURHOOD) + p % width / NEIGHBOURHOOD;
        neighbourhoods[place] += usize::from(other_depth || leaps_far);
    }
    [found.depths, found.colors, found.leaps, found.vessel_share] =
        [depths, colors, leaps, found.vessels].map(|n| n as f64 / pixels as f64);
    found.together = neighbourhoods.into_iter().max().unwrap_or(0);
    found
}

/// Asserts that two frames differ only by rounding.
pub fn assert_equal(a: &Frame, b: &Frame) {
    let found = compare(a, b);
    assert!(found.depths <= DEPTH.share, "depths: {found:?}");
    assert!(found.vessel_share <= DEPTH.share, "vessels: {found:?}");
    assert!(found.colors <= COLOR.share, "colours: {found:?}");
    assert!(found.leaps <= COLOR_LEAP.share, "colours far apart: {found:?}");
    assert!(found.together <= MOST_TOGETHER, "one place: {found:?}");
}

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
    use lumencut_core::geometry::Geometry;
    use lumencut_core::stages::{Image, ImageSet};

    use super::*;
    use crate::brute_force::by_hierarchy;
    use crate::pictures::depth_of;
    use crate::settings::unfiltered;
    use crate::trees::trefoil;
    use crate::views::front;

    fn frame(size: [usize; 2]) -> Frame {
        let camera = front(size, 0.5);
        let at = |p: usize| (p % size[0], p / size[0]);
        let grey = |(i, j): (usize, usize)| ((i * 5 + j * 3) % 251) as u8;
        let pixels = 0..size[0] * size[1];
        Frame {
            image: pixels.clone().map(|p| [grey(at(p)), 9, 200, 255]).collect(),
            vessel: pixels.clone().map(|p| i32::from(at(p).1 > 30)).collect(),
            ..Frame::of(Geometry::Orthographic {
                camera,
                depth: pixels.map(|p| at(p).0 as f32 * 0.3 - 20.0).collect(),
            })
        }
    }

    fn refused(a: &Frame, b: &Frame) -> Option<String> {
        let result = std::panic::catch_unwind(|| assert_equal(a, b));
        result.err().map(|words| {
            words.downcast_ref::<String>().cloned().unwrap_or_else(|| {
                words.downcast_ref::<&str>().map(|words| (*words).to_owned()).unwrap_or_default()
            })
        })
    }

    /// Asserts that `assert_equal` rejects a changed frame with a message that contains `words`.
    fn refuses(words: &str, size: [usize; 2], change: impl Fn(&mut Frame)) {
        let (a, mut b) = (frame(size), frame(size));
        assert_eq!(refused(&a, &b), None, "before the change");
        change(&mut b);
        for found in [refused(&a, &b), refused(&b, &a)] {
            assert!(found.as_ref().is_some_and(|found| found.contains(words)), "{words}: {found:?}");
        }
    }

    const SIZE: [usize; 2] = [200, 160];

    #[test]
    fn rounding_is_no_difference() {
        let (a, mut b) = (frame(SIZE), frame(SIZE));
        b.image.iter_mut().for_each(|color| *color = color.map(|c| c.saturating_add(1)));
        depth_of(&mut b).iter_mut().for_each(|depth| *depth += 5e-4);
        // Few isolated pixels differ: 16 of 32,000 in colour, three of these clearly, and 32 in depth.
        (0..13).for_each(|n| b.image[n * 2001][2] -= 4);
        (0..3).for_each(|n| b.image[n * 9001 + 50][2] = 0);
        (0..32).for_each(|n| depth_of(&mut b)[n * 999] += 7.0);
        assert_equal(&a, &b);
        let found = compare(&a, &b);
        assert_eq!((found.largest_color, found.vessels), (200, 0));
        assert_eq!((found.depths, found.colors, found.leaps), (32.0 / 32e3, 16.0 / 32e3, 3.0 / 32e3));
    }

    #[test]
    fn a_change_the_size_of_a_vessel_is_seen() {
        let block = |b: &mut Frame, [wide, high]: [usize; 2], width: usize| {
            for p in (0..high).flat_map(|j| (0..wide).map(move |i| (j + 72) * width + i + 96)) {
                b.image[p][0] ^= 64;
            }
        };
        refuses("colours: ", SIZE, |b| block(b, [40, 6], 200));
        // In a picture of this size, the fraction of differing pixels is small enough; their number in one block is not.
        refuses("one place", [1000, 1000], |b| block(b, [10, 6], 1000));
        refuses("one place", [1000, 1000], |b| {
            (0..6)
                .flat_map(|j| (0..10).map(move |i| (j + 72) * 1000 + i + 96))
                .for_each(|p| depth_of(b)[p] += 1.0);
        });
    }

    #[test]
    fn a_change_of_alpha_alone_is_seen() {
        refuses("colours: ", SIZE, |b| b.image.iter_mut().for_each(|color| color[3] = 252));
    }

    #[test]
    fn a_shifted_picture_is_seen() {
        refuses("colours: ", SIZE, |b| b.image.rotate_right(1));
        refuses("depths: ", SIZE, |b| depth_of(b).rotate_right(1));
    }

    #[test]
    fn other_vessels_are_seen() {
        refuses("vessels: ", SIZE, |b| b.vessel.iter_mut().take(33).for_each(|id| *id += 1));
    }

    #[test]
    fn colours_too_many_and_too_far_apart_are_seen() {
        refuses("colours: ", SIZE, |b| (0..17).for_each(|n| b.image[n * 1800][2] -= 2));
        refuses("colours far apart: ", SIZE, |b| (0..4).for_each(|n| b.image[n * 1800][2] -= 5));
    }

    #[test]
    fn depths_of_a_few_pixels_more_are_seen() {
        refuses("depths: ", SIZE, |b| (0..33).for_each(|n| depth_of(b)[n * 900] += 2e-3));
        refuses("depths: ", SIZE, |b| (0..33).for_each(|n| depth_of(b)[n * 900] = f32::NAN));
    }

    #[test]
    fn missing_and_misshapen_images_are_refused() {
        refuses("image: different sizes", SIZE, |b| b.image.clear());
        refuses("depth: different sizes", SIZE, |b| {
            *b = b.clone().keeping(ImageSet::of(&[Image::Picture, Image::Vessel]));
        });
        refuses("different views", SIZE, |b| *b = frame([160, 200]));
        let mut nothing = frame(SIZE);
        nothing = nothing.keeping(ImageSet::of(&[]));
        assert!(
            refused(&nothing, &nothing.clone()).is_some_and(|words| words.contains("nothing to compare"))
        );
        let (mut a, mut b) = (frame(SIZE), frame(SIZE));
        a.image.truncate(200);
        b.image.truncate(200);
        assert!(refused(&a, &b).is_some_and(|words| words.contains("image: 200 of 32000 pixels")));
    }

    #[test]
    fn an_image_is_not_compared_with_itself() {
        let a = frame(SIZE);
        assert!(refused(&a, &a).is_some_and(|words| words.contains("compared with itself")));
    }

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
