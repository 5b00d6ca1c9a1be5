use super::*;
use glam::DVec3;
use lumencut_core::stop::go_on;

#[test]
fn the_share_grows_by_each_question_and_by_each_vessel() {
    let progress = Progress::default();
    progress.expect_views(2);
    let vessel = Vessel::new(vec![DVec3::ZERO, DVec3::Z * 9.0], None).expect("a vessel");
    let mut shares = Vec::new();
    for _ in 0..2 {
        // Ten sections in three passes make 30 calls; one more call still reports completion.
        with_progress(Some(&progress), (std::slice::from_ref(&vessel), 1.0), &|| false, |stop| {
            for _ in 0..31 {
                go_on(stop)?;
                shares.push((progress.share() * 60.0).round() as usize);
            }
            Ok(())
        })
        .expect("nobody stopped it");
    }
    let expected = (1..=30).chain([30]).chain(31..=60).chain([60]).collect::<Vec<_>>();
    assert_eq!(shares, expected);
    assert_eq!(progress.share(), 1.0);
}

#[test]
fn it_stops_where_it_is_asked_to() {
    let progress = Progress::default();
    let vessel = Vessel::new(vec![DVec3::ZERO, DVec3::Z], None).expect("a vessel");
    for progress_of in [None, Some(&progress)] {
        assert!(with_progress(progress_of, (std::slice::from_ref(&vessel), 1.0), &|| true, go_on).is_err());
    }
}
