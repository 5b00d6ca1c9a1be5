use std::collections::BTreeSet;

use super::{Side, VESSEL_NAMES, vessel_named};

fn offered() -> Vec<String> {
    VESSEL_NAMES.iter().flat_map(super::NamedVessel::offered).collect()
}

#[test]
fn every_offered_name_has_its_own_code_and_side() {
    let mut found = BTreeSet::new();
    for name in offered() {
        let (vessel, side) = vessel_named(&name).unwrap_or_else(|| panic!("{name} has no code"));
        assert!(vessel.snomed.len() >= 6 && !vessel.meaning.is_empty(), "{name}");
        assert_eq!(side.is_some(), vessel.is_paired, "{name}");
        let side = side.map(Side::code);
        assert!(found.insert((vessel.snomed, side)), "{name} has the code of another name");
    }
    assert_eq!(found.len(), 63);
}

/// The last digit of a SNOMED CT identifier is a check digit (Verhoeff), the two before it are 00 for concepts of the core.
#[test]
fn codes_have_a_valid_check_digit() {
    for vessel in VESSEL_NAMES {
        assert!(is_valid(vessel.snomed), "{}", vessel.name);
        assert_eq!(&vessel.snomed[vessel.snomed.len() - 3..vessel.snomed.len() - 1], "00", "{}", vessel.name);
    }
    assert!(Side::ALL.into_iter().all(|side| is_valid(side.code().0)));
    assert!(!is_valid("2841008") && !is_valid("2814007"));
}

/// Sources give it three numbers: 50040 (with its branches), 4685 (stem) and 3855 (trunk).
#[test]
fn only_the_left_main_coronary_artery_has_no_number_in_the_fma() {
    let without = VESSEL_NAMES.iter().filter(|vessel| vessel.fma.is_none()).map(|vessel| vessel.name);
    assert_eq!(without.collect::<Vec<_>>(), ["left main coronary artery"]);
    let numbers: BTreeSet<u32> = VESSEL_NAMES.iter().filter_map(|vessel| vessel.fma).collect();
    assert_eq!(numbers.len(), VESSEL_NAMES.len() - 1);
}

#[test]
fn no_two_vessels_share_a_name() {
    let names: Vec<&str> =
        VESSEL_NAMES.iter().flat_map(|vessel| [&[vessel.name], vessel.synonyms].concat()).collect();
    assert_eq!(names.iter().collect::<BTreeSet<_>>().len(), names.len());
    assert!(names.iter().all(|name| *name == name.to_lowercase()));
}

#[test]
fn only_complete_names_match() {
    let site = |name: &str| vessel_named(name).map(|(vessel, side)| (vessel.name, side));
    assert_eq!(site("left renal artery"), Some(("renal artery", Some(Side::Left))));
    assert_eq!(site("ICA R"), Some(("internal carotid artery", Some(Side::Right))));
    assert_eq!(site("ICA_left"), Some(("internal carotid artery", Some(Side::Left))));
    assert_eq!(site("Left gastric artery"), Some(("left gastric artery", None)));
    assert_eq!(site("abdominal aorta 12"), Some(("abdominal aorta", None)));
    assert_eq!(site("Renal artery"), Some(("renal artery", None)));
    for name in ["", "12", "Erica", "aorta of Jane", "left LAD", "left aorta", "left right renal artery", "ı"]
    {
        assert_eq!(site(name), None, "{name}");
    }
}

/// Verhoeff's check, from the multiplication of the dihedral group of order ten.
fn is_valid(code: &str) -> bool {
    const PERMUTED: [u8; 10] = [1, 5, 7, 6, 2, 8, 3, 0, 9, 4];
    fn product(a: u8, b: u8) -> u8 {
        match (a < 5, b < 5) {
            (true, true) => (a + b) % 5,
            (true, false) => 5 + (a + b - 5) % 5,
            (false, true) => 5 + (a - b) % 5,
            (false, false) => (a + 5 - b) % 5,
        }
    }
    let permuted = |digit: u8, times: usize| (0..times).fold(digit, |digit, _| PERMUTED[usize::from(digit)]);
    code.bytes().rev().enumerate().fold(0, |sum, (n, byte)| product(sum, permuted(byte - b'0', n % 8))) == 0
}
