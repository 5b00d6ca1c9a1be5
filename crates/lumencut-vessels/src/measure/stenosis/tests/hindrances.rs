use super::super::made_profile::profile;
use super::*;
use crate::measure::section::flags::RECENTERED;
use crate::measure::section::flags::{AT_LIMIT, BRANCH, NO_EDGE, OUTSIDE, RESTLESS_LINE};
use glam::DVec3;

/// A vessel along z that is 8 mm wide and 40 mm long.
fn vessel() -> Profile {
    let mut made = profile(&[[8.0, 0.1]; 81]);
    for n in 0..made.len() {
        made.center[n] = DVec3::Z * made.arc_length[n];
    }
    made
}

fn where_is(profile: &Profile, bit: u32) -> Option<[f64; 2]> {
    let found = profile.hindrances();
    let mut there = (0..profile.len()).filter(|n| found[*n] & bit != 0).map(|n| profile.arc_length[n]);
    let first = there.next()?;
    Some([first, there.next_back().unwrap_or(first)])
}

#[test]
fn flags_that_make_a_section_no_lumen_to_rely_on_hinder_it() {
    for flag in [METAL, CALCIUM, NO_EDGE, BRANCH, OUTSIDE, RECENTERED, RESTLESS_LINE] {
        let mut made = vessel();
        made.flags[30] = flag;
        assert_eq!(where_is(&made, flag), Some([15.0, 15.0]), "{flag}");
    }
    let mut made = vessel();
    made.flags[30] = AT_LIMIT;
    made.flags[40] = NEIGHBOR;
    made.flags[50] = IRREGULAR;
    assert!(made.hindrances().iter().all(|hindrance| *hindrance == 0));
}

#[test]
fn a_diameter_that_is_unsure_by_a_third_hinders() {
    let mut made = vessel();
    made.uncertainty[10] = 2.7;
    made.area[20] = f64::NAN;
    assert_eq!(where_is(&made, UNSURE), Some([5.0, 10.0]));
    assert_eq!(made.hindrances().iter().filter(|hindrance| **hindrance == UNSURE).count(), 2);
}

#[test]
fn where_the_middle_jumps_there_is_another_lumen_one_diameter_around() {
    let mut made = vessel();
    for center in &mut made.center[40..] {
        *center += DVec3::X * 2.6;
    }
    assert_eq!(where_is(&made, CHANGE_OF_LUMEN), Some([11.5, 28.0]));
    // A vessel at 45° to its centerline, or one with a slight shift, has no change of lumen.
    let mut made = vessel();
    for n in 0..made.len() {
        made.center[n].x = made.arc_length[n] + if n < 40 { 0.0 } else { 1.0 };
    }
    assert_eq!(where_is(&made, CHANGE_OF_LUMEN), None);
}

#[test]
fn half_of_a_jump_is_a_change_where_level_or_width_step_too() {
    let aside = |change: &dyn Fn(&mut Profile)| {
        let mut made = vessel();
        for center in &mut made.center[40..] {
            *center += DVec3::X * 1.5;
        }
        change(&mut made);
        where_is(&made, CHANGE_OF_LUMEN).is_some()
    };
    assert!(!aside(&|_| {}));
    assert!(aside(&|made| made.levels[40..].fill([400.0, 50.0])));
    assert!(aside(&|made| made.area[40..].fill(PI * 36.0)));
    // If only contrast medium mixes, the level changes by less than the limit.
    assert!(!aside(&|made| made.levels[40..].fill([350.0, 50.0])));
}

#[test]
fn a_step_of_the_width_in_one_lumen_is_no_change_of_lumen() {
    let mut made = vessel();
    made.area[40..].fill(PI);
    assert_eq!(where_is(&made, CHANGE_OF_LUMEN), None);
}

#[test]
fn a_neighbor_beside_an_irregular_wall_is_a_flap_one_diameter_around() {
    let mut made = vessel();
    made.flags[40] = NEIGHBOR | IRREGULAR;
    assert_eq!(where_is(&made, FLAP), Some([12.0, 28.0]));
}
