//! The value of a header attribute as it was read, with conversions. A header may contain a text or several
//! numbers instead of one number, so callers check values when they use them.

use std::fmt;

use serde::de::{Deserialize, Deserializer, IgnoredAny, MapAccess, SeqAccess, Visitor};

use crate::wording::quoted;

/// The value of one attribute. In JSON it is `null`, a number, a text without padding at the end, or a list
/// of these. DS and IS are passed as texts, non-finite numbers as `nan`, `inf` and `-inf`, a sequence as its
/// number of items, and anything else as `true`.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Value {
    /// The attribute is empty or not stated.
    #[default]
    Empty,
    /// An integer.
    Integer(i64),
    /// A number that is not an integer.
    Number(f64),
    /// A text.
    Text(String),
    /// A list of values.
    List(Vec<Value>),
    /// A value of another type, such as binary data.
    Odd,
}

impl Value {
    /// Whether no value is stated.
    pub fn is_empty(&self) -> bool {
        match self {
            Self::Empty => true,
            Self::Text(text) => text.is_empty(),
            Self::List(values) => values.is_empty(),
            _ => false,
        }
    }

    /// Whether no value, or zero, is stated.
    pub fn is_nothing(&self) -> bool {
        self.is_empty()
            || matches!(self, Self::Integer(0))
            || matches!(self, Self::Number(zero) if *zero == 0.0)
    }

    /// The value as a single number, even if written as text; may be infinite or NaN.
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Integer(number) => Some(*number as f64),
            Self::Number(number) => Some(*number),
            Self::Text(text) => text.trim().parse().ok(),
            _ => None,
        }
    }

    /// The value as a single integer, even if written as text.
    pub fn integer(&self) -> Option<i64> {
        match self {
            Self::Integer(number) => Some(*number),
            Self::Number(number) if number.fract() == 0.0 && number.abs() < 1e15 => Some(*number as i64),
            Self::Text(text) => text.trim().parse().ok(),
            _ => None,
        }
    }

    /// All values of a list, or the single value; empty if nothing is stated.
    pub fn all(&self) -> &[Self] {
        match self {
            Self::List(values) => values,
            _ if self.is_empty() => &[],
            _ => std::slice::from_ref(self),
        }
    }
}

/// Writes values as Python does.
impl fmt::Display for Value {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => formatter.write_str("None"),
            Self::Integer(number) => write!(formatter, "{number}"),
            Self::Number(number) => write!(formatter, "{number:?}"),
            Self::Text(text) => formatter.write_str(text),
            Self::List(values) => {
                let inside = |value: &Self| match value {
                    Self::Text(text) => quoted(text),
                    other => other.to_string(),
                };
                let inside: Vec<String> = values.iter().map(inside).collect();
                write!(formatter, "[{}]", inside.join(", "))
            }
            Self::Odd => formatter.write_str("damaged values"),
        }
    }
}

impl<'de> Deserialize<'de> for Value {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(AnyValue)
    }
}

/// Accepts any JSON value, because no header value may make the document invalid.
struct AnyValue;

impl<'de> Visitor<'de> for AnyValue {
    type Value = Value;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a value of a header")
    }

    fn visit_unit<E>(self) -> Result<Value, E> {
        Ok(Value::Empty)
    }

    fn visit_bool<E>(self, _: bool) -> Result<Value, E> {
        Ok(Value::Odd)
    }

    fn visit_i64<E>(self, number: i64) -> Result<Value, E> {
        Ok(Value::Integer(number))
    }

    fn visit_u64<E>(self, number: u64) -> Result<Value, E> {
        Ok(i64::try_from(number).map_or(Value::Odd, Value::Integer))
    }

    fn visit_f64<E>(self, number: f64) -> Result<Value, E> {
        Ok(Value::Number(number))
    }

    fn visit_str<E>(self, text: &str) -> Result<Value, E> {
        Ok(Value::Text(text.to_owned()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Value, A::Error> {
        let mut values = Vec::new();
        while let Some(value) = list.next_element()? {
            values.push(value);
        }
        Ok(Value::List(values))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Value, A::Error> {
        while map.next_entry::<IgnoredAny, IgnoredAny>()?.is_some() {}
        Ok(Value::Odd)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(json: &str) -> Value {
        serde_json::from_str(json).expect("a value")
    }

    #[test]
    fn every_json_is_a_value() {
        for (json, expected) in [
            ("null", Value::Empty),
            ("7", Value::Integer(7)),
            ("-7.5", Value::Number(-7.5)),
            ("18446744073709551615", Value::Odd),
            ("true", Value::Odd),
            (r#"{"a": [1]}"#, Value::Odd),
            (r#"["a", null]"#, Value::List(vec![Value::Text("a".into()), Value::Empty])),
        ] {
            assert_eq!(value(json), expected);
        }
    }

    #[test]
    fn numbers_may_be_texts() {
        assert_eq!(value(r#"" 0.1 ""#).number(), Some(0.1));
        assert_eq!(value(r#""inf""#).number(), Some(f64::INFINITY));
        assert_eq!(value(r#""0003""#).integer(), Some(3));
        assert_eq!(value("2.0").integer(), Some(2));
        for odd in [r#""DOE^J""#, "[1, 2]", "null", "true", r#""""#] {
            assert_eq!((value(odd).number(), value(odd).integer()), (None, None), "{odd}");
        }
        assert_eq!(value("2.5").integer(), None);
        assert_eq!(value(r#""99999999999999999999""#).integer(), None);
    }

    #[test]
    fn values_are_written_as_python_writes_them() {
        for (json, text) in [
            ("null", "None"),
            ("40.0", "40.0"),
            (r#"["ORIGINAL", 2]"#, "['ORIGINAL', 2]"),
            (r#""B30f""#, "B30f"),
        ] {
            assert_eq!(value(json).to_string(), text);
        }
    }
}
