//! Reads real numbers, rounded to the nearest.

/// The number that a word stands for, as Rust and Python read it.
#[cfg(not(target_arch = "wasm32"))]
pub(crate) fn real(word: &str) -> Option<f64> {
    word.parse().ok()
}

/// The same. The reader of the browser is used, since Rust's has tables that take a fifth of a small module.
#[cfg(target_arch = "wasm32")]
pub(crate) fn real(word: &str) -> Option<f64> {
    let plain = word.strip_prefix(['+', '-']).unwrap_or(word);
    let is_one_of = |names: &[&str]| names.iter().any(|name| plain.eq_ignore_ascii_case(name));
    let is_part = |byte: u8| byte.is_ascii_digit() || b".eE+-".contains(&byte);
    let value = if is_one_of(&["inf", "infinity"]) {
        f64::INFINITY
    } else if is_one_of(&["nan"]) {
        f64::NAN
    } else if !plain.is_empty() && !plain.starts_with(['+', '-']) && plain.bytes().all(is_part) {
        Some(browser::number(plain)).filter(|value| !value.is_nan())?
    } else {
        return None;
    };
    Some(if word.starts_with('-') { -value } else { value })
}

#[cfg(target_arch = "wasm32")]
mod browser {
    use wasm_bindgen::prelude::wasm_bindgen;

    #[wasm_bindgen]
    extern "C" {
        #[wasm_bindgen(js_name = Number)]
        fn number_of(text: &str) -> f64;
    }

    /// NaN for words that are no numbers.
    pub(super) fn number(word: &str) -> f64 {
        number_of(word)
    }
}
