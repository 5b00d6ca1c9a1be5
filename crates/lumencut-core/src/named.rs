//! Values that are chosen by name.

use crate::error::{Error, ErrorKind, Result};

/// Values with names, the same in Python, on the command line and in a browser.
pub trait Named: Copy + PartialEq + 'static {
    /// Each value with its name, in display order.
    const NAMES: &'static [(&'static str, Self)];

    /// The names, in display order.
    fn names() -> Vec<&'static str> {
        Self::NAMES.iter().map(|(name, _)| *name).collect()
    }

    /// The name of this value.
    fn name(self) -> &'static str {
        Self::NAMES.iter().find(|(_, value)| *value == self).map_or("", |(name, _)| *name)
    }

    /// The value called `name` for `subject`. Fails with [`ErrorKind::Settings`] for any other name.
    fn named(subject: &str, name: &str) -> Result<Self> {
        if let Some((_, value)) = Self::NAMES.iter().find(|(known, _)| *known == name) {
            return Ok(*value);
        }
        let known: Vec<_> = Self::names().iter().map(|name| format!("'{name}'")).collect();
        let expected = format!("one of {}", known.join(", "));
        Err(Error::new(ErrorKind::Settings, subject, format!("'{name}'"), expected))
    }
}
