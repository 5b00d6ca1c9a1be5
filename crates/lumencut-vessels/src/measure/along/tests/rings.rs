use super::*;

#[test]
fn the_rings_of_a_stent_are_one_stretch_of_metal() {
    let at: Vec<f64> = (0..12).map(f64::from).collect();
    let mut flags = [METAL, 0, CALCIUM | NEIGHBOR, METAL, CALCIUM, 0, 0, 0, 0, 0, METAL, CALCIUM];
    join_rings(&at, &mut flags);
    assert_eq!(flags, [METAL, METAL, METAL, METAL, CALCIUM, 0, 0, 0, 0, 0, METAL, CALCIUM]);
}

#[test]
fn between_metal_what_is_bright_all_the_way_is_metal() {
    let at: Vec<f64> = (0..12).map(|n| 3.0 * f64::from(n)).collect();
    let mut flags = [CALCIUM; 12];
    [flags[2], flags[9]] = [METAL; 2];
    let mut dark_between = flags;
    join_rings(&at, &mut flags);
    assert!(flags[2..=9].iter().all(|flags| *flags == METAL));
    assert!(flags[..2].iter().chain(&flags[10..]).all(|flags| *flags == CALCIUM));
    dark_between[5] = 0;
    join_rings(&at, &mut dark_between);
    assert_eq!(dark_between[4..7], [CALCIUM, 0, CALCIUM]);
}

/// Sections 1 mm apart: a stent of 8 mm, then what `behind` says, then another stent of 8 mm.
fn between_stents(behind: &[u32]) -> Vec<u32> {
    let mut flags = [&[METAL; 9][..], behind, &[METAL; 9]].concat();
    let at: Vec<f64> = (0..flags.len()).map(|n| n as f64).collect();
    join_rings(&at, &mut flags);
    flags[9..9 + behind.len()].to_vec()
}

#[test]
fn struts_that_look_like_calcium_at_the_end_of_a_stent_are_metal() {
    let calcium = [[CALCIUM; 10], [0; 10]].concat();
    assert_eq!(between_stents(&calcium), [[METAL; 10], [0; 10]].concat());
    // A vessel beside is not the stent, but struts may lie behind it.
    let beside = [vec![NEIGHBOR; 3], vec![CALCIUM; 2], vec![NEIGHBOR; 5], vec![0; 10]].concat();
    assert_eq!(between_stents(&beside), [vec![METAL; 5], vec![NEIGHBOR; 5], vec![0; 10]].concat());
    // A single bright ring is no stent, so calcium next to it stays calcium.
    let mut ring = [CALCIUM, METAL, CALCIUM, 0];
    join_rings(&[0.0, 1.0, 2.0, 3.0], &mut ring);
    assert_eq!(ring, [CALCIUM, METAL, CALCIUM, 0]);
}

#[test]
fn between_two_stents_a_vessel_beside_is_metal_too() {
    assert_eq!(between_stents(&[NEIGHBOR; 30]), [METAL; 30]);
    assert_eq!(between_stents(&[NEIGHBOR; 90]), [NEIGHBOR; 90], "they are too far apart");
    assert_eq!(between_stents(&[[NEIGHBOR; 10], [0; 10]].concat())[..10], [NEIGHBOR; 10]);
}

#[test]
fn a_section_that_misses_the_struts_does_not_divide_a_stent() {
    let missed = |count: usize| [vec![NEIGHBOR; 30], vec![0; count], vec![NEIGHBOR; 15]].concat();
    assert_eq!(between_stents(&missed(2)), [METAL; 47]);
    assert_eq!(between_stents(&missed(8)), missed(8), "a longer part is free");
}

#[test]
fn within_metal_other_reasons_give_way() {
    let mut flags = [METAL | CALCIUM | NEIGHBOR; 3];
    join_rings(&[0.0, 1.0, 2.0], &mut flags);
    assert_eq!(flags, [METAL; 3]);
}
