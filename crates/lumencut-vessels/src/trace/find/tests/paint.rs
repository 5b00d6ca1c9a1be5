use super::*;

const MIDDLE: DVec3 = DVec3::new(-3.2, 15.9, 40.0);

#[test]
fn a_ball_is_painted_across_blocks_and_nothing_beyond_it() {
    let mut paint = Paint::default();
    paint.lumen(7, MIDDLE, 3.0, &|_| false);
    for offset in [DVec3::ZERO, DVec3::X * 2.2, DVec3::Y * -2.4, DVec3::splat(1.2)] {
        assert_eq!(paint.at(MIDDLE + offset), Painted::Lumen(7), "{offset}");
    }
    assert_eq!(paint.at(MIDDLE + DVec3::X * 4.0), Painted::Empty);
    assert_eq!(paint.at(MIDDLE + DVec3::splat(2.5)), Painted::Empty);
}

#[test]
fn lumen_is_painted_over_rejected_middles_and_over_lumen_that_gives_way() {
    let mut paint = Paint::default();
    paint.rejected(MIDDLE, 0.2);
    assert_eq!(paint.at(MIDDLE), Painted::Rejected);
    paint.lumen(1, MIDDLE, 1.0, &|_| false);
    paint.rejected(MIDDLE, 0.2);
    paint.lumen(2, MIDDLE, 1.0, &|_| false);
    assert_eq!(paint.at(MIDDLE), Painted::Lumen(1));
    paint.lumen(3, MIDDLE, 1.0, &|other| other == 1);
    assert_eq!(paint.at(MIDDLE), Painted::Lumen(3));
}
