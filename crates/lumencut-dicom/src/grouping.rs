//! Groups elements by a key.

use std::collections::HashMap;

pub(crate) fn groups(keys: impl IntoIterator<Item = String>) -> Vec<Vec<usize>> {
    together(keys.into_iter().collect())
}

fn together(keys: Vec<String>) -> Vec<Vec<usize>> {
    let (mut places, mut groups) = (HashMap::new(), Vec::<Vec<usize>>::new());
    for (number, key) in keys.into_iter().enumerate() {
        let place = *places.entry(key).or_insert(groups.len());
        if place == groups.len() {
            groups.push(Vec::new());
        }
        groups[place].push(number);
    }
    groups
}

#[cfg(test)]
mod tests {
    #[test]
    fn equal_keys_are_together() {
        let keys = ["b", "a", "b", "c", "a"].map(String::from);
        assert_eq!(super::groups(keys), [vec![0, 2], vec![1, 4], vec![3]]);
    }
}
