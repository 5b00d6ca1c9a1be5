use std::collections::HashSet;

use super::*;

#[test]
fn words_and_meanings_are_those_of_readers_and_not_of_the_code() {
    for (name, word) in [
        ("NEIGHBOR", "vessel beside"),
        ("RECENTERED", "centre moved"),
        ("IRREGULAR", "not round"),
        ("NO_EDGE", "no clear wall"),
    ] {
        assert_eq!(FLAGS.iter().find(|flag| flag.name == name).map(|flag| flag.word), Some(word));
    }
    assert_eq!(FLAGS.iter().map(|flag| flag.word).collect::<HashSet<_>>().len(), FLAGS.len());
    assert!(FLAGS.iter().all(|flag| flag.meaning.split(' ').count() > 4));
}

#[test]
fn no_two_flags_share_a_bit_or_a_colour() {
    let bits: HashSet<u32> = FLAGS.iter().map(|flag| flag.bit).collect();
    assert_eq!(bits, (0..FLAGS.len()).map(|n| 1 << n).collect());
    for color in [|flag: &FlagLook| flag.paper, |flag: &FlagLook| flag.screen] {
        assert_eq!(FLAGS.iter().map(color).collect::<HashSet<_>>().len(), FLAGS.len());
    }
}

#[test]
fn flags_that_are_set_come_in_the_order_of_the_table() {
    let words: Vec<&str> = set_in(NO_EDGE | BRANCH).map(|flag| flag.word).collect();
    assert_eq!(words, ["branch", "no clear wall"]);
    assert_eq!(set_in(0).count(), 0);
}
