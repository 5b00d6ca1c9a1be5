use super::*;

const SIZE: [usize; 3] = [7, 6, 5];
const REACH: [usize; 3] = [2, 1, 1];

fn places() -> impl Iterator<Item = [usize; 3]> {
    let [ni, nj, nk] = SIZE;
    (0..nk).flat_map(move |k| (0..nj).flat_map(move |j| (0..ni).map(move |i| [i, j, k])))
}

fn is_near(a: [usize; 3], b: [usize; 3]) -> bool {
    (0..3).all(|axis| a[axis].abs_diff(b[axis]) <= REACH[axis])
}

/// By definition: a voxel belongs to the closed set unless a voxel near it has none of the set near it.
#[test]
fn spreading_and_closing_do_what_their_definitions_say() {
    let all: Vec<[usize; 3]> = places().collect();
    for seed in 0..8_usize {
        let set: Vec<bool> = (0..all.len()).map(|n| (n * 2_654_435_761 + seed * 97) % 23 < 2).collect();
        let spread_by_hand = |is_set: &dyn Fn(usize) -> bool| -> Vec<bool> {
            let near =
                |at: &[usize; 3]| all.iter().enumerate().any(|(n, other)| is_set(n) && is_near(*at, *other));
            all.iter().map(near).collect()
        };
        let expected = spread_by_hand(&|n| set[n]);
        let (mut found, mut both) = (set.clone(), set.clone());
        spread(&mut found, SIZE, REACH, &|| false).expect("memory");
        assert_eq!(found, expected);
        closed(&mut both, SIZE, REACH, &|| false).expect("memory");
        let outside = spread_by_hand(&|n| !expected[n]);
        assert_eq!(both, outside.iter().map(|is| !is).collect::<Vec<_>>());
        assert!(set.iter().zip(&both).all(|(was, is)| *is || !was), "nothing is lost");
    }
}
