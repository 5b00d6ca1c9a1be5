//! A link between two tracks.

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Link {
    /// Index of one track, and index of its point.
    pub from: [usize; 2],
    /// Index of the other track, and index of its point.
    pub to: [usize; 2],
    /// Cost of the link (mm).
    pub cost: f64,
    /// Length of the link outside both lumens (mm).
    pub gap: f64,
    /// Lowest level along the link: 0 is tissue, 1 is lumen.
    pub level: f64,
}

impl Link {
    pub(crate) fn order(&self, other: &Self) -> std::cmp::Ordering {
        let numbers = |link: &Self| (link.from, link.to);
        self.cost.total_cmp(&other.cost).then_with(|| numbers(self).cmp(&numbers(other)))
    }
}
