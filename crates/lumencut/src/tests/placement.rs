use glam::DAffine3;

use super::*;
use crate::extent::Extent;
use crate::lumen_points::LumenCount;
use crate::misplaced::{Misplaced, better_place, fits_nowhere};
use crate::places::{SMALLEST, across};
use lumencut_io::Mend;

/// A volume of 100 mm sides, so far from the origin that only one space fits.
fn volume() -> Extent {
    Extent::new([101; 3], DAffine3::from_translation(DVec3::splat(20.0)))
}

fn nothing() -> Known {
    Known {
        asked_space: None,
        asked_unit: None,
        stated_space: None,
        stated_unit: None,
        usual_unit: Unit::Millimetre,
    }
}

fn points(space: Space, unit: Unit) -> Vec<DVec3> {
    let scale = CoordinateSystem { space, unit }.scale();
    (0..50).map(|n| DVec3::splat(30.0 + f64::from(n)) / scale).collect()
}

fn silent(extent: Extent) -> Judge<'static> {
    Judge { extent, lumen: &|_| LumenCount::default() }
}

fn decided(known: &Known, points: &[DVec3]) -> Placement {
    placement(known, points, Some(&silent(volume()))).unwrap()
}

#[test]
fn what_is_asked_rules_and_contradictions_are_told() {
    let known = Known {
        asked_space: Some(Space::Ras),
        asked_unit: Some(Unit::Metre),
        stated_space: Some(Space::Lps),
        ..nothing()
    };
    let found = decided(&known, &points(Space::Lps, Unit::Millimetre));
    assert_eq!(found.place, CoordinateSystem { space: Space::Ras, unit: Unit::Metre });
    assert_eq!((found.space_from, found.unit_from), (Origin::Asked, Origin::Asked));
    assert_eq!(found.decision, "the file states lps; read as ras as asked");
    assert!(!found.is_unusual);
}

#[test]
fn without_a_volume_the_usual_is_assumed() {
    let found = placement(&nothing(), &points(Space::Ras, Unit::Millimetre), None).unwrap();
    assert_eq!(found.place, CoordinateSystem { space: Space::Lps, unit: Unit::Millimetre });
    assert_eq!((found.space_from, found.unit_from), (Origin::Assumed, Origin::Assumed));
    assert_eq!(found.decision, "the file states no space and no unit; lps in mm is assumed");
}

#[test]
fn the_volume_confirms_the_usual_place() {
    let found = decided(&nothing(), &points(Space::Lps, Unit::Millimetre));
    assert_eq!((found.space_from, found.unit_from), (Origin::Volume, Origin::Volume));
    let expected = "lps in mm fits the volume (50 of 50 points inside, 0 in ras)";
    assert_eq!(found.decision, format!("the file states no space and no unit; {expected}"));
    assert!(!found.is_unusual);
    assert_eq!(found.confirmed_by, Statement::default());
}

#[test]
fn the_volume_decides_against_the_usual_place() {
    let known = Known { stated_unit: Some(Unit::Millimetre), ..nothing() };
    let found = decided(&known, &points(Space::Ras, Unit::Millimetre));
    assert_eq!(found.place, CoordinateSystem { space: Space::Ras, unit: Unit::Millimetre });
    assert_eq!((found.space_from, found.unit_from), (Origin::Volume, Origin::Stated));
    let counts = "0 of 50 points lie inside the volume in lps in mm, but 50 in ras in mm";
    assert_eq!(found.decision, format!("the file states no space; {counts}: read so"));
    assert_eq!(found.confirmed_by, Statement { space: Some(Space::Ras), unit: None });
    assert!(found.is_unusual);
}

#[test]
fn a_space_and_a_unit_can_both_be_unusual() {
    let found = decided(&nothing(), &points(Space::Ras, Unit::Centimetre));
    assert_eq!(found.place, CoordinateSystem { space: Space::Ras, unit: Unit::Centimetre });
    assert_eq!(found.confirmed_by, Statement { space: Some(Space::Ras), unit: Some(Unit::Centimetre) });
}

#[test]
fn spaces_that_fit_alike_are_left_to_the_caller() {
    let around = Extent::new([101; 3], DAffine3::from_translation(DVec3::splat(-50.0)));
    let points: Vec<DVec3> = (0..20).map(|n| DVec3::splat(f64::from(n) - 10.0)).collect();
    let error = placement(&nothing(), &points, Some(&silent(around))).unwrap_err().in_file("lines.csv");
    let found = "coordinates that are not stated and that the volume does not decide: lps in mm (20 of 20 points \
                 inside), ras in mm (20 of 20 points inside)";
    let mend = "state the space, lps or ras";
    assert_eq!(
        error.to_string(),
        format!("lines.csv: found {found}; expected a space and unit that fit; {mend}")
    );
    assert_eq!(error.mended_by.as_deref(), Some(&Mend::Coordinates));
}

#[test]
fn units_that_fit_alike_are_left_to_the_caller() {
    let wide = Extent::new([2001; 3], DAffine3::from_translation(DVec3::splat(150.0)));
    let points: Vec<DVec3> = (0..20).map(|n| DVec3::splat(16.0 + 0.1 * f64::from(n))).collect();
    let known = Known { stated_space: Some(Space::Lps), ..nothing() };
    let error = placement(&known, &points, Some(&silent(wide))).unwrap_err();
    let units = vec![Unit::Centimetre, Unit::Decimetre];
    assert_eq!(error.mended_by.as_deref(), Some(&Mend::Unit(units)));
    assert!(error.to_string().ends_with("; state the unit, cm or dm"), "{error}");
}

#[test]
fn centerlines_of_another_volume_are_refused() {
    let far: Vec<DVec3> = (0..50).map(|n| DVec3::new(7000.0, f64::from(n), 0.0)).collect();
    let error = placement(&nothing(), &far, Some(&silent(volume()))).unwrap_err();
    assert_eq!(error.found, "no point inside the volume, in lps or ras, in um, mm, cm, dm, m");
    assert_eq!(error.mended_by.as_deref(), Some(&Mend::Place));
    // A space that the file states is not asked for.
    let known = Known { stated_space: Some(Space::Ras), ..nothing() };
    let found = decided(&known, &far);
    assert_eq!(found.place, CoordinateSystem { space: Space::Ras, unit: Unit::Millimetre });
    assert_eq!(found.decision, "the file states no unit; ras in mm is assumed");
}

#[test]
fn a_better_place_is_named() {
    assert_eq!(better_place(&points(Space::Lps, Unit::Millimetre), &silent(volume())), None);
    let better = better_place(&points(Space::Ras, Unit::Centimetre), &silent(volume())).unwrap();
    let how = "with x and y negated (LPS and RAS mixed up?) and 10 times as large (another unit?)";
    let found = format!("0 of 50 points lie inside the volume as read, but 50 {how}");
    let meant = CoordinateSystem { space: Space::Ras, unit: Unit::Centimetre };
    assert_eq!(better, Misplaced { found, meant });
}

#[test]
fn a_few_points_more_are_no_better_place() {
    // Three of fifty points fit only if x and y are negated; that is less than a tenth.
    let mut mixed = vec![DVec3::splat(7000.0); 47];
    mixed.extend_from_slice(&points(Space::Ras, Unit::Millimetre)[..3]);
    assert_eq!(better_place(&mixed, &silent(volume())), None);
    mixed.extend_from_slice(&points(Space::Ras, Unit::Millimetre)[3..6]);
    let better = better_place(&mixed, &silent(volume())).expect("a tenth of the points fits");
    assert_eq!(better.meant, CoordinateSystem { space: Space::Ras, unit: Unit::Millimetre });
}

#[test]
fn what_misses_the_volume_everywhere_is_said_so() {
    assert!(!fits_nowhere(&points(Space::Ras, Unit::Metre), &volume()));
    assert!(fits_nowhere(&[DVec3::new(7000.0, 0.0, 0.0), DVec3::new(7000.0, 9.0, 0.0)], &volume()));
}

fn around_the_origin() -> (Extent, Vec<DVec3>) {
    let around = Extent::new([101; 3], DAffine3::from_translation(DVec3::splat(-50.0)));
    (around, (0..20).map(|n| DVec3::splat(f64::from(n) - 10.0)).collect())
}

/// Lumen counts of a hundred points, read as LPS and as RAS.
fn counts(lps: usize, ras: usize) -> impl Fn(CoordinateSystem) -> LumenCount {
    move |place| LumenCount { like_lumen: if place.space == Space::Lps { lps } else { ras }, of: 100 }
}

#[test]
fn between_spaces_that_fit_alike_the_values_decide_where_they_are_evident() {
    let (extent, points) = around_the_origin();
    let found = |lps, ras, known: &Known| {
        placement(known, &points, Some(&Judge { extent, lumen: &counts(lps, ras) }))
    };
    for (lps, ras, space) in [(90, 30, Space::Lps), (30, 90, Space::Ras), (50, 0, Space::Lps)] {
        let found = found(lps, ras, &nothing()).unwrap();
        assert_eq!(
            (found.place, found.space_from),
            (CoordinateSystem { space, unit: Unit::Millimetre }, Origin::Values)
        );
        assert_eq!((found.unit_from, found.is_unusual), (Origin::Volume, true));
        let (best, other) = if space == Space::Lps { ("lps", "ras") } else { ("ras", "lps") };
        let expected = format!(
            "the file states no space and no unit; both {best} in mm (20 of 20 points inside) and {other} in mm (20) fit the \
             volume; of 100 sampled points, {} look like lumen in {best} and {} in {other}: read in {best}",
            lps.max(ras),
            lps.min(ras),
        );
        assert_eq!(found.decision, expected);
        assert_eq!(found.confirmed_by, Statement { space: Some(space), unit: None });
    }
    // The counts are too similar, or too small.
    for (lps, ras) in [(90, 31), (31, 90), (49, 0), (0, 0), (70, 70)] {
        let error = found(lps, ras, &nothing()).unwrap_err();
        assert_eq!(error.mended_by.as_deref(), Some(&Mend::Coordinates), "{error}");
    }
    // Stated or requested choices are not compared with the values.
    let stated = Known { stated_space: Some(Space::Lps), ..nothing() };
    assert_eq!(found(0, 100, &stated).unwrap().place.space, Space::Lps);
    let asked = Known { asked_space: Some(Space::Ras), ..nothing() };
    assert_eq!(found(100, 0, &asked).unwrap().place.space, Space::Ras);
}

#[test]
fn fewer_than_twenty_points_decide_nothing() {
    let of = |like_lumen, of| LumenCount { like_lumen, of };
    assert!(of(20, 20).is_evident_over(of(6, 20)));
    assert!(!of(19, 19).is_evident_over(of(0, 19)));
}

#[test]
fn values_that_speak_for_the_mirrored_lines_are_told() {
    let (extent, points) = around_the_origin();
    let described = |lps, ras| better_place(&points, &Judge { extent, lumen: &counts(lps, ras) });
    let found = "of 100 sampled points, 20 look like lumen as read, but 80 with x and y negated (LPS and RAS mixed up?)";
    let meant = CoordinateSystem { space: Space::Ras, unit: Unit::Millimetre };
    assert_eq!(described(20, 80), Some(Misplaced { found: found.into(), meant }));
    assert_eq!((described(80, 20), described(30, 80), described(0, 49)), (None, None, None));
    // Lines stay as they were read if they would leave the volume when mirrored.
    let judge = Judge { extent: volume(), lumen: &counts(0, 100) };
    assert_eq!(better_place(&self::points(Space::Lps, Unit::Millimetre), &judge), None);
}

/// A 640 mm cube of 1 mm voxels around a position.
fn cube_around(middle: DVec3) -> Extent {
    Extent::new([640; 3], DAffine3::from_translation(middle - 319.5))
}

fn line_of(length: f64, middle: DVec3, place: CoordinateSystem) -> Vec<DVec3> {
    let along = |n: i32| (f64::from(n) / 49.0 - 0.5) * length;
    let point = |n| middle + DVec3::new(3.0 * (along(n) / 9.0).sin(), -6.0, along(n));
    (0..50).map(|n| point(n) / place.scale()).collect()
}

/// What a caller states who follows a remedy, for each of its choices.
fn followed(mend: &Mend, known: &Known) -> Vec<Known> {
    let space = |space: &Space| Known { asked_space: Some(*space), ..*known };
    let unit = |unit: &Unit| Known { asked_unit: Some(*unit), ..*known };
    match mend {
        Mend::Coordinates => Space::ALL.iter().map(space).collect(),
        Mend::Unit(units) => units.iter().map(unit).collect(),
        Mend::Reading(all) => {
            let both = |(space, unit): &(Space, Unit)| Known {
                asked_space: Some(*space),
                asked_unit: Some(*unit),
                ..*known
            };
            all.iter().map(both).collect()
        }
        Mend::Place | Mend::Reorder => panic!("the lines lie in the volume, in order"),
    }
}

/// Follows every remedy until the points are read; returns whether one path leads to the truth.
fn leads_to(truth: CoordinateSystem, known: &Known, points: &[DVec3], judge: &Judge) -> bool {
    match placement(known, points, Some(judge)) {
        Ok(found) => {
            let doubted = found.doubt.iter().flat_map(|doubt| &doubt.units).chain(&found.also);
            let units: Vec<Unit> = doubted.copied().collect();
            assert!(
                known.asked_unit.is_some() || found.place.unit == truth.unit || units.contains(&truth.unit),
                "{} points in {truth} are read as {} without a word",
                points.len(),
                found.place
            );
            found.place == truth
                || units
                    .into_iter()
                    .any(|unit| leads_to(truth, &Known { asked_unit: Some(unit), ..*known }, points, judge))
        }
        Err(error) => {
            let mend = error.mended_by.as_deref().expect("a mend");
            followed(mend, known).iter().any(|known| leads_to(truth, known, points, judge))
        }
    }
}

const TRIED: [Unit; 4] = [Unit::Micrometre, Unit::Millimetre, Unit::Centimetre, Unit::Metre];

fn tried() -> impl Iterator<Item = (Vec<DVec3>, CoordinateSystem, Extent)> {
    let middles = [DVec3::new(20.0, -30.0, 5.0), DVec3::new(700.0, 800.0, 400.0)];
    let of = move |middle: DVec3, length: f64| {
        let of = move |place: CoordinateSystem| (line_of(length, middle, place), place, cube_around(middle));
        places(&Space::ALL, &TRIED).into_iter().map(of)
    };
    middles
        .into_iter()
        .flat_map(move |middle| [20.0, 72.0, 600.0].into_iter().flat_map(move |l| of(middle, l)))
}

#[test]
fn no_unit_is_wrong_without_a_word_and_every_mend_leads_to_the_place() {
    for (points, truth, extent) in tried() {
        let judge = silent(extent);
        let stated = |space, unit| Known { stated_space: space, stated_unit: unit, ..nothing() };
        let mut tried = vec![nothing(), stated(Some(truth.space), None)];
        // A statement with a plausible size is trusted, even if 600 mm in cm are read as 60 mm.
        if !(SMALLEST..300.0).contains(&across(&points)) {
            tried.push(stated(Some(truth.space), Some(Unit::Millimetre)));
        }
        for known in tried {
            assert!(leads_to(truth, &known, &points, &judge), "{truth}, {known:?}, {} mm", across(&points));
        }
        // A caller who states both space and unit is trusted.
        let asked = Known { asked_space: Some(truth.space), asked_unit: Some(truth.unit), ..nothing() };
        let found = placement(&asked, &points, Some(&judge)).expect("what was asked");
        assert_eq!((found.place, found.doubt, found.also), (truth, None, Vec::new()));
    }
}

#[test]
fn values_tell_the_unit_where_they_are_evident() {
    for (points, truth, extent) in tried() {
        let lumen = |place| LumenCount { like_lumen: if place == truth { 90 } else { 20 }, of: 100 };
        let judge = Judge { extent, lumen: &lumen };
        for stated_space in [None, Some(truth.space)] {
            let found =
                placement(&Known { stated_space, ..nothing() }, &points, Some(&judge)).expect("described");
            assert_eq!(found.place, truth, "{}", found.decision);
            assert!(found.is_unusual || truth.unit == Unit::Millimetre && found.also.is_empty());
        }
    }
    let middle = DVec3::new(20.0, -30.0, 5.0);
    let truth = CoordinateSystem { space: Space::Lps, unit: Unit::Centimetre };
    let lumen = |place| LumenCount { like_lumen: if place == truth { 90 } else { 20 }, of: 100 };
    let judge = Judge { extent: cube_around(middle), lumen: &lumen };
    let known = Known { stated_space: Some(Space::Lps), ..nothing() };
    let found = placement(&known, &line_of(600.0, middle, truth), Some(&judge)).expect("described");
    let described = "the file states no unit; lps in mm (50 of 50 points inside, 60 mm across), lps in cm (50 of 50 points \
                inside, 600 mm across) fit the volume; 20 of 100 sampled points look like lumen in lps in mm, but 90 of \
                100 sampled points look like lumen in lps in cm: read in cm";
    assert_eq!((found.decision.as_str(), found.unit_from), (described, Origin::Values));
    assert_eq!(found.confirmed_by, Statement { space: None, unit: Some(Unit::Centimetre) });
}

#[test]
fn a_size_that_is_none_is_told_without_a_volume_too() {
    let at = CoordinateSystem { space: Space::Ras, unit: Unit::Metre };
    let points = line_of(72.0, DVec3::ZERO, at);
    let stated = Known { stated_space: Some(Space::Ras), stated_unit: Some(Unit::Millimetre), ..nothing() };
    for known in [nothing(), stated] {
        let doubt = placement(&known, &points, None).expect("a place").doubt.expect("a doubt");
        assert_eq!(doubt.units, [Unit::Metre]);
        assert!(doubt.found.starts_with("the lines are 0.072"), "{}", doubt.found);
        assert!(doubt.found.contains("mm across in mm, 72."), "{}", doubt.found);
    }
    let points = line_of(72.0, DVec3::ZERO, CoordinateSystem { unit: Unit::Millimetre, ..at });
    assert_eq!(placement(&stated, &points, None).expect("a place").doubt, None);
}

#[test]
fn lines_of_a_few_voxels_are_told_of_with_the_volume_that_they_lie_in() {
    let middle = DVec3::new(20.0, -30.0, 5.0);
    let points = line_of(72.0, middle, CoordinateSystem { space: Space::Lps, unit: Unit::Metre });
    let better = better_place(&points, &silent(cube_around(middle))).expect("a better place");
    assert!(
        better.found.starts_with("50 of 50 points lie inside the volume as read, 0.072"),
        "{}",
        better.found
    );
    assert_eq!(better.meant, CoordinateSystem { space: Space::Lps, unit: Unit::Metre });
    assert!(!fits_nowhere(&points, &cube_around(middle)));
}
