//! The patient spaces in which files give coordinates.

/// The patient space in which coordinates are given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Space {
    /// x to the left, y to the back, z to the head.
    Lps,
    /// x to the right, y to the front, z to the head.
    Ras,
}

impl Space {
    /// Both spaces.
    pub const ALL: [Self; 2] = [Self::Lps, Self::Ras];

    /// Name of the space: `lps` or `ras`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Lps => "lps",
            Self::Ras => "ras",
        }
    }
}
