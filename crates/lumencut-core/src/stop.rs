//! How a caller asks long work to stop.

use crate::error::{Error, Result};

/// Asked again and again during long work, from any thread, whether to stop.
pub type Stop<'a> = &'a (dyn Fn() -> bool + Sync);

/// An error where the caller asks to stop.
///
/// # Errors
/// [`crate::error::ErrorKind::Interrupted`].
pub fn go_on(stop: Stop) -> Result<()> {
    if stop() { Err(Error::interrupted()) } else { Ok(()) }
}
