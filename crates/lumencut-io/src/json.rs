//! Reads fields of JSON without building a tree.

use std::fmt;

use serde_core::Deserializer;
use serde_core::de::{IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde_json::value::RawValue;

use crate::error::Result;

#[derive(Clone, Copy)]
pub(crate) struct Json<'a>(&'a RawValue);

impl<'a> Json<'a> {
    pub(crate) fn of(bytes: &'a [u8]) -> serde_json::Result<Self> {
        serde_json::from_slice(bytes).map(Self)
    }

    pub(crate) fn raw(self) -> &'a str {
        self.0.get()
    }

    pub(crate) fn text(self) -> Option<String> {
        serde_json::from_str(self.raw()).ok()
    }

    pub(crate) fn number(self) -> Option<f64> {
        serde_json::from_str(self.raw()).ok()
    }

    pub(crate) fn three_numbers(self) -> Option<[f64; 3]> {
        serde_json::from_str(self.raw()).ok()
    }

    /// Fields with these names (the last of duplicates); None if null or missing, or not in an object.
    pub(crate) fn fields<const N: usize>(self, names: [&str; N]) -> [Option<Self>; N] {
        let fields = serde_json::Deserializer::from_str(self.raw()).deserialize_map(Fields(names));
        fields.unwrap_or([None; N]).map(|field| field.filter(|value| value.raw() != "null"))
    }

    /// Calls `take` for each list element until the first error; returns the count, None for no list.
    pub(crate) fn each(self, take: impl FnMut(usize, Self) -> Result<()>) -> Option<Result<usize>> {
        serde_json::Deserializer::from_str(self.raw()).deserialize_seq(Each(take)).ok()
    }
}

struct Fields<'n, const N: usize>([&'n str; N]);

impl<'a, const N: usize> Visitor<'a> for Fields<'_, N> {
    type Value = [Option<Json<'a>>; N];

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("an object")
    }

    fn visit_map<A: MapAccess<'a>>(self, mut map: A) -> std::result::Result<Self::Value, A::Error> {
        let mut out = [None; N];
        while let Some(key) = map.next_key::<String>()? {
            match self.0.iter().position(|name| *name == key) {
                Some(i) => out[i] = Some(Json(map.next_value()?)),
                None => drop(map.next_value::<IgnoredAny>()?),
            }
        }
        Ok(out)
    }
}

struct Each<F>(F);

impl<'a, F: FnMut(usize, Json<'a>) -> Result<()>> Visitor<'a> for Each<F> {
    type Value = Result<usize>;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a list")
    }

    fn visit_seq<A: SeqAccess<'a>>(mut self, mut list: A) -> std::result::Result<Self::Value, A::Error> {
        let mut count = Ok(0);
        // The parser must reach the end of the list, so it reads on after an error.
        while let Some(element) = list.next_element()? {
            count = count.and_then(|i| (self.0)(i, Json(element)).map(|()| i + 1));
        }
        Ok(count)
    }
}
