//! Units of length in files.

/// A unit of length that files use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// 1/1000 mm.
    Micrometre,
    /// 1 mm; [`Centerlines::scaled`](crate::Centerlines::scaled) converts to this unit.
    Millimetre,
    /// 10 mm.
    Centimetre,
    /// 100 mm.
    Decimetre,
    /// 1000 mm.
    Metre,
}

impl Unit {
    /// All units, the smallest first.
    pub const ALL: [Self; 5] =
        [Self::Micrometre, Self::Millimetre, Self::Centimetre, Self::Decimetre, Self::Metre];

    /// Length of the unit in mm.
    #[must_use]
    pub fn in_mm(self) -> f64 {
        match self {
            Self::Micrometre => 1e-3,
            Self::Millimetre => 1.0,
            Self::Centimetre => 10.0,
            Self::Decimetre => 100.0,
            Self::Metre => 1000.0,
        }
    }

    /// Short name: `um`, `mm`, `cm`, `dm` or `m`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Micrometre => "um",
            Self::Millimetre => "mm",
            Self::Centimetre => "cm",
            Self::Decimetre => "dm",
            Self::Metre => "m",
        }
    }

    /// The unit with this short name; both characters for µ are accepted.
    pub(crate) fn of_name(name: &str) -> Option<Self> {
        let name = name.replace(['\u{b5}', '\u{3bc}'], "u");
        Self::ALL.into_iter().find(|unit| unit.name() == name)
    }

    /// Factor that converts lengths to `other`; exactly 1 for the same unit.
    pub(crate) fn in_units_of(self, other: Self) -> f64 {
        self.in_mm() / other.in_mm()
    }
}
