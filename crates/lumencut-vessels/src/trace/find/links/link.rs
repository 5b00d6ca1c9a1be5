//! A link between two tracks.

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Link {
    /// Track and point number.
    pub from: [usize; 2],
    /// Track and point number.
    pub to: [usize; 2],
    /// Cost (mm).
    pub cost: f64,
    /// Length outside both lumens (mm).
    pub gap: f64,
    /// Lowest level on the way: 0 tissue, 1 lumen.
    pub level: f64,
}

impl Link {
    pub(crate) fn order(&self, other: &Self) -> std::cmp::Ordering {
        let numbers = |link: &Self| (link.from, link.to);
        self.cost.total_cmp(&other.cost).then_with(|| numbers(self).cmp(&numbers(other)))
    }
}
