use super::*;
use crate::trace::find::made::with_scan;

const SIZE: [usize; 3] = [84, 80, 76];

fn levels(value: impl Fn(DVec3) -> f64, range: [f64; 2], work: impl Fn(&Pyramid)) {
    with_scan(SIZE, 1.0, value, |scan| {
        let grid = Grid::over(scan.voxels, 0.5);
        work(&Pyramid::new(scan.voxels, grid, range, &|| false).expect("levels"));
    });
}

#[test]
fn a_slope_is_the_same_slope_on_all_levels_away_from_the_edge() {
    let slope = |place: DVec3| 100.0 + 2.0 * place.x + place.y - place.z;
    levels(slope, [0.0, 400.0], |pyramid| {
        assert_eq!(pyramid.levels.iter().map(|level| level.side).collect::<Vec<_>>(), [1.0, 2.0, 4.0]);
        for level in &pyramid.levels {
            for place in [DVec3::new(20.3, 19.6, 18.1), DVec3::new(16.0, 24.5, 15.9)] {
                let lanes = level.at_lanes(&(place / level.side).to_array().map(|c| [c as f32; 4]));
                assert!((f64::from(level.at(place)) - slope(place)).abs() < 0.02, "{}", level.side);
                assert!((f64::from(lanes[3]) - slope(place)).abs() < 0.02, "{lanes:?}");
            }
        }
    });
}

#[test]
fn values_are_clamped_to_the_range_and_beyond_the_volume_they_are_those_of_its_edge() {
    let steep = |place: DVec3| 50.0 * place.x - 500.0;
    levels(steep, [0.0, 1000.0], |pyramid| {
        let finest = &pyramid.levels[0];
        assert_eq!(finest.at(DVec3::new(3.0, 5.0, 5.0)), 0.0);
        assert!((finest.at(DVec3::new(40.0, 5.0, 5.0)) - 1000.0).abs() < 0.02);
        assert_eq!(finest.at(DVec3::new(20.0, -7.0, 90.0)), finest.at(DVec3::new(20.0, 0.0, 75.0)));
    });
}

#[test]
fn what_is_no_number_is_the_lowest_value() {
    levels(|_| f64::NAN, [0.0, 100.0], |pyramid| assert!(pyramid.levels[0].voxels.iter().all(|v| *v == 0)));
}

#[test]
fn a_narrow_tube_is_looked_at_on_the_finest_level_and_a_wide_one_on_the_coarsest() {
    levels(
        |_| 0.0,
        [0.0, 1.0],
        |pyramid| {
            let side =
                |radius: f64, levels_examined: Range<usize>| pyramid.level_for(radius, &levels_examined).side;
            assert_eq!([3.9, 4.0, 8.0, 50.0].map(|radius| side(radius, 0..3)), [1.0, 2.0, 4.0, 4.0]);
            assert_eq!([1.0, 50.0].map(|radius| side(radius, 1..2)), [2.0, 2.0]);
        },
    );
}
