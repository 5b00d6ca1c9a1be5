//! Names of SOP classes and transfer syntaxes (PS3.6, table A-1).

use std::collections::HashMap;
use std::sync::LazyLock;

static NAMES: LazyLock<HashMap<&str, &str>> =
    LazyLock::new(|| include_str!("uids.txt").lines().filter_map(|line| line.split_once(' ')).collect());

pub(crate) fn name(uid: &str) -> Option<&'static str> {
    NAMES.get(uid).copied()
}

#[cfg(test)]
mod tests {
    use super::name;

    #[test]
    fn kinds_and_syntaxes_have_names() {
        assert_eq!(name("1.2.840.10008.5.1.4.1.1.2"), Some("CT Image Storage"));
        assert_eq!(name("1.2.840.10008.1.2.4.90"), Some("JPEG 2000 Image Compression (Lossless Only)"));
        assert_eq!(name("1.2.3"), None);
    }
}
