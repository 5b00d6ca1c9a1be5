use super::*;

fn places(length: f64, step: f64) -> Result<usize> {
    let line = Vessel::new(vec![DVec3::ZERO, DVec3::Z * length], None)?;
    Track::new(&line, None)?.places(step).map(|places| places.len())
}

#[test]
fn more_sections_than_can_be_measured_are_refused_with_a_step_that_mends_it() {
    let refused = places(2000.0, 0.01).expect_err("200,001 sections");
    assert_eq!(refused.kind, ErrorKind::Settings);
    let words = refused.to_string();
    assert!(words.contains("0.01 mm, which makes 200001 sections of a vessel of 2000 mm"), "{words}");
    assert!(words.contains("at most 20000 sections; give a step of 0.11 mm or more"), "{words}");
    assert!(places(2000.0, 0.11).is_ok_and(|count| count <= 20_000));
    assert_eq!(places(1999.9, 0.1).ok(), Some(20_000));
    assert!(places(2000.0, 0.1).is_err());
}

#[test]
fn a_step_that_is_no_length_is_refused() {
    for step in [0.0, -0.5, f64::NAN, f64::INFINITY] {
        let words = places(20.0, step).expect_err("no length").to_string();
        assert!(words.contains("a number above 0 mm"), "{words}");
    }
}
