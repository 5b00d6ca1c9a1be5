//! Numbers of records, stored as JSON without loss.

use std::fmt;

use serde::de::{Error, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

pub(crate) type Numbers = Vec<Recorded>;

/// A number that is null if NaN, and a text if infinite, since JSON has neither.
#[derive(Clone, Copy, Debug)]
pub struct Recorded(f64);

pub(crate) fn recorded(numbers: Vec<f64>) -> Numbers {
    numbers.into_iter().map(Recorded).collect()
}

pub(crate) fn restored(numbers: &[Recorded]) -> Vec<f64> {
    numbers.iter().map(|number| number.0).collect()
}

const INFINITIES: [(&str, f64); 2] = [("infinity", f64::INFINITY), ("-infinity", f64::NEG_INFINITY)];

impl PartialEq for Recorded {
    fn eq(&self, other: &Self) -> bool {
        self.0.to_bits() == other.0.to_bits()
    }
}

impl Serialize for Recorded {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match INFINITIES.iter().find(|(_, number)| *number == self.0) {
            Some((word, _)) => serializer.serialize_str(word),
            None => serializer.serialize_f64(self.0),
        }
    }
}

impl<'de> Deserialize<'de> for Recorded {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(AnyNumber).map(Self)
    }
}

struct AnyNumber;

impl Visitor<'_> for AnyNumber {
    type Value = f64;

    fn expecting(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.write_str("a number, null or an infinity")
    }

    fn visit_f64<E: Error>(self, number: f64) -> Result<f64, E> {
        Ok(number)
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<f64, E> {
        Ok(number as f64)
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<f64, E> {
        Ok(number as f64)
    }

    fn visit_unit<E: Error>(self) -> Result<f64, E> {
        Ok(f64::NAN)
    }

    fn visit_str<E: Error>(self, word: &str) -> Result<f64, E> {
        let found = INFINITIES.iter().find(|(other, _)| *other == word);
        found.map(|(_, number)| *number).ok_or_else(|| E::custom("an infinity in other words"))
    }
}
