//! A link between two tracks.

/// A link from a point of one track to a point of another one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Link {
    /// The track it comes from, and the number of its point there.
    pub from: [usize; 2],
    /// The track that it leads to, and the number of its point there.
    pub to: [usize; 2],
    /// What it costs (mm).
    pub cost: f64,
    /// How much of it lies outside the lumens of both tracks (mm): a gap that it bridges.
    pub gap: f64,
    /// The lowest level along it: 0 that of the tissue around, 1 that of the lumens.
    pub level: f64,
}

impl Link {
    /// What decides between links of the same cost: the numbers of what they link.
    pub(crate) fn order(&self, other: &Self) -> std::cmp::Ordering {
        let numbers = |link: &Self| (link.from, link.to);
        self.cost.total_cmp(&other.cost).then_with(|| numbers(self).cmp(&numbers(other)))
    }
}
