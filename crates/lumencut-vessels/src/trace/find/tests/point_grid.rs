use super::*;
use lumencut_scenes::random::Random;

#[test]
fn points_near_a_place_are_those_of_a_look_at_all() {
    let mut random = Random::new(3);
    let places: Vec<DVec3> = (0..500).map(|_| 40.0 * random.next_point()).collect();
    let grid = PointGrid::new(places.clone(), 5.0);
    for reach in [0.0, 2.0, 7.0, 200.0] {
        for place in [places[7], DVec3::ZERO, DVec3::new(-60.0, 3.0, 50.0), DVec3::splat(1e9)] {
            let mut found = Vec::new();
            grid.near(place, reach, |n| found.push(n));
            found.sort_unstable();
            let expected: Vec<usize> =
                (0..places.len()).filter(|n| places[*n].distance(place) <= reach).collect();
            assert_eq!(found, expected, "{reach} mm around {place}");
        }
    }
    PointGrid::new(Vec::new(), 5.0).near(DVec3::ZERO, 1.0, |_| panic!("no point is there"));
}
