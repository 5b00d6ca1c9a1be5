//! Chooses names for the vessels that an edit adds.

/// A name that is not in use: the kind and the first free number, such as `Branch 3`.
pub(crate) fn fresh_name(taken: &[String], kind: &str) -> String {
    let mut name = String::new();
    for number in 1..=taken.len() + 1 {
        name = format!("{kind} {number}");
        if !taken.contains(&name) {
            break;
        }
    }
    name
}

/// The name of the second part of a cut vessel; the first part keeps the name.
pub fn part_name(taken: &[String], whole: &str) -> String {
    fresh_name(taken, &format!("{whole} part"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_free_number_is_taken() {
        let taken = ["Branch 1", "Branch 3", "LAD", "LAD part 1"].map(str::to_owned);
        assert_eq!(fresh_name(&taken, "Branch"), "Branch 2");
        assert_eq!(fresh_name(&taken, "Vessel"), "Vessel 1");
        assert_eq!(fresh_name(&[], "Vessel"), "Vessel 1");
        assert_eq!(part_name(&taken, "LAD"), "LAD part 2");
        let all = ["Mask 1", "Mask 2"].map(str::to_owned);
        assert_eq!(fresh_name(&all, "Mask"), "Mask 3");
    }
}
