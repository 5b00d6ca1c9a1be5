//! Types of stored numbers.

/// The type of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs)]
pub enum Kind {
    Int8,
    Uint8,
    Int16,
    Uint16,
    Int32,
    Uint32,
    Int64,
    Uint64,
    Float32,
    Float64,
}

impl Kind {
    /// All types.
    pub const ALL: [Self; 10] = [
        Self::Int8,
        Self::Uint8,
        Self::Int16,
        Self::Uint16,
        Self::Int32,
        Self::Uint32,
        Self::Int64,
        Self::Uint64,
        Self::Float32,
        Self::Float64,
    ];

    /// The type's name in NumPy.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Int8 => "int8",
            Self::Uint8 => "uint8",
            Self::Int16 => "int16",
            Self::Uint16 => "uint16",
            Self::Int32 => "int32",
            Self::Uint32 => "uint32",
            Self::Int64 => "int64",
            Self::Uint64 => "uint64",
            Self::Float32 => "float32",
            Self::Float64 => "float64",
        }
    }

    /// The type with this name in NumPy.
    #[must_use]
    pub fn of_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// Bytes of a number.
    #[must_use]
    pub const fn bytes(self) -> usize {
        match self {
            Self::Int8 | Self::Uint8 => 1,
            Self::Int16 | Self::Uint16 => 2,
            Self::Int32 | Self::Uint32 | Self::Float32 => 4,
            Self::Int64 | Self::Uint64 | Self::Float64 => 8,
        }
    }

    /// Whether the numbers are integers.
    #[must_use]
    pub(crate) const fn is_integer(self) -> bool {
        !matches!(self, Self::Float32 | Self::Float64)
    }

    /// The smallest and the largest integer; for floating-point types, those of signed integers of the same size.
    pub(crate) const fn limits(self) -> (i128, i128) {
        let bits = 8 * self.bytes();
        match self {
            Self::Uint8 | Self::Uint16 | Self::Uint32 | Self::Uint64 => (0, (1 << bits) - 1),
            _ => (-(1 << (bits - 1)), (1 << (bits - 1)) - 1),
        }
    }

    /// The first type, of this one and five others, that holds all integers from `low` to `high`.
    pub(crate) fn holding(self, low: i128, high: i128) -> Option<Self> {
        [self, Self::Int16, Self::Uint16, Self::Int32, Self::Uint32, Self::Int64].into_iter().find(|kind| {
            let (least, most) = kind.limits();
            least <= low && high <= most
        })
    }

    /// The type in which the engine stores the numbers: an integer type if it is exact, else float32.
    #[must_use]
    pub(crate) const fn in_the_engine(self) -> Self {
        match self {
            Self::Uint8 | Self::Int16 | Self::Uint16 => self,
            Self::Int8 => Self::Int16,
            _ => Self::Float32,
        }
    }
}

/// A value is `slope · stored + intercept`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scaling {
    /// The factor.
    pub slope: f64,
    /// The number added.
    pub intercept: f64,
}

impl Scaling {
    /// No scaling.
    pub const NONE: Self = Self { slope: 1.0, intercept: 0.0 };

    pub(crate) fn is_none(self) -> bool {
        self == Self::NONE
    }

    pub(crate) fn is_integral(self) -> bool {
        let is_whole = |value: f64| value.is_finite() && value.fract() == 0.0;
        is_whole(self.slope) && is_whole(self.intercept)
    }

    /// The type that holds all values, given the smallest and the largest stored number.
    pub(crate) fn kind_of(self, stored: Kind, (low, high): (i128, i128)) -> Kind {
        const WIDEST: i128 = 1 << 62;
        let (slope, intercept) = (self.slope as i128, self.intercept as i128);
        let of = |end: i128| end.saturating_mul(slope).saturating_add(intercept);
        let (one, other) = (of(low), of(high));
        let held = stored.holding(one.min(other), one.max(other));
        held.filter(|_| high < WIDEST).unwrap_or(Kind::Float32)
    }
}

pub(crate) fn settled(stored: Kind, scaling: Scaling) -> Option<Kind> {
    match stored {
        _ if scaling.is_none() => Some(stored),
        Kind::Float64 => Some(Kind::Float64),
        _ if stored.is_integer() && scaling.is_integral() => None,
        _ => Some(Kind::Float32),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integers_stay_integers_where_a_type_holds_them() {
        let shifted = Scaling { slope: 1.0, intercept: -1024.0 };
        assert_eq!(shifted.kind_of(Kind::Uint16, (0, 4095)), Kind::Int16);
        assert_eq!(shifted.kind_of(Kind::Int16, (-1024, 3000)), Kind::Int16);
        assert_eq!(shifted.kind_of(Kind::Uint16, (0, 65535)), Kind::Int32);
        assert_eq!(shifted.kind_of(Kind::Uint64, (0, u64::MAX.into())), Kind::Float32);
        let huge = Scaling { slope: 1e30, intercept: 0.0 };
        assert_eq!(huge.kind_of(Kind::Int8, (0, 1)), Kind::Float32);
    }
}
