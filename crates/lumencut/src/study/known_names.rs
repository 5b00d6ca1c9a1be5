//! Suggested names that lines keep: the rules need the branches, which users remove when they clean up.

use std::collections::HashMap;

use crate::suggested_names::SuggestedName;

/// The last suggestion for each line. A line never changes; an edited vessel has a new one.
#[derive(Clone, Debug, Default)]
pub(crate) struct KnownNames(HashMap<usize, SuggestedName>);

impl KnownNames {
    /// The suggestions for lines. One without a name keeps its last one, unless the rules now give it to another line.
    pub(crate) fn with(&self, lines: &[usize], suggested: Vec<SuggestedName>) -> Vec<SuggestedName> {
        let given: Vec<Option<String>> = suggested.iter().map(|one| one.name.clone()).collect();
        let kept = |(line, one): (&usize, SuggestedName)| match self.0.get(line) {
            Some(known) if one.name.is_none() && !(known.name.is_some() && given.contains(&known.name)) => {
                known.clone()
            }
            _ => one,
        };
        lines.iter().zip(suggested).map(kept).collect()
    }

    pub(crate) fn keep(&mut self, lines: &[usize], suggested: Vec<SuggestedName>) -> Vec<SuggestedName> {
        let all = self.with(lines, suggested);
        self.0.extend(lines.iter().copied().zip(all.iter().cloned()));
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn named(name: Option<&str>, is_vein_or_heart: bool) -> SuggestedName {
        SuggestedName { name: name.map(str::to_owned), is_vein_or_heart, ..SuggestedName::default() }
    }

    #[test]
    fn lines_keep_their_names_until_the_rules_give_them_another_or_give_theirs_away() {
        let mut known = KnownNames::default();
        let all = [named(Some("Aorta"), false), named(Some("Left renal artery"), false), named(None, true)];
        assert_eq!(known.keep(&[1, 2, 3], all.to_vec()), all);
        let none = named(None, false);
        assert_eq!(known.keep(&[1, 3], vec![none.clone(), none.clone()]), [all[0].clone(), all[2].clone()]);
        let aorta = named(Some("Aorta"), false);
        assert_eq!(known.with(&[1, 4], vec![none.clone(), aorta.clone()]), [none, aorta]);
        let other = named(Some("Abdominal aorta"), false);
        assert_eq!(known.with(&[1], vec![other.clone()]), [other]);
    }
}
