//! How a caller asks long work to stop.

use crate::error::{Error, Result};

/// Returns whether to stop; polled during long work, from any thread.
pub type Stop<'a> = &'a (dyn Fn() -> bool + Sync);

/// Never stops, for short work or for callers without a way to stop it.
pub const NEVER: Stop<'static> = &|| false;

/// Number of entries written between two checks for stop.
const ENTRIES_PER_CHECK: usize = 1 << 20;

/// Fails once the caller asks to stop.
pub fn go_on(stop: Stop) -> Result<()> {
    if stop() { Err(Error::interrupted()) } else { Ok(()) }
}

/// Resizes a list and polls `stop`: the first touch of the memory of a large image takes seconds.
pub(crate) fn resize<T: Clone>(list: &mut Vec<T>, count: usize, value: T, stop: Stop) -> Result<()> {
    list.truncate(count);
    list.reserve_exact(count - list.len());
    while list.len() < count {
        go_on(stop)?;
        list.resize(count.min(list.len() + ENTRIES_PER_CHECK), value.clone());
    }
    Ok(())
}

/// A list of `count` entries of one value, as by `resize`.
pub fn filled<T: Clone>(count: usize, value: T, stop: Stop) -> Result<Vec<T>> {
    let mut list = Vec::new();
    resize(&mut list, count, value, stop)?;
    Ok(list)
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;
    use crate::error::ErrorKind;

    #[test]
    fn a_list_is_filled_in_parts_until_the_caller_asks_to_stop() {
        let count = 3 * ENTRIES_PER_CHECK + 5;
        let asked = AtomicUsize::new(0);
        let never = || asked.fetch_add(1, Ordering::Relaxed) > count;
        let mut list = filled(count, 7_u8, &never).unwrap();
        assert!(list.len() == count && list.iter().all(|entry| *entry == 7));
        assert_eq!(asked.into_inner(), 4);
        resize(&mut list, 2, 0, NEVER).unwrap();
        resize(&mut list, 4, 0, NEVER).unwrap();
        assert_eq!(list, [7, 7, 0, 0]);
        assert_eq!(filled(count, 7_u8, &|| true).unwrap_err().kind, ErrorKind::Interrupted);
    }
}
