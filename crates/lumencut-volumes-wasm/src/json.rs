//! Writes JSON. A library for it would take a third of the module.

/// A string.
pub(crate) fn text(text: &str) -> String {
    let mut out = String::from('"');
    for letter in text.chars() {
        match letter {
            '"' | '\\' => out.extend(['\\', letter]),
            '\0'..' ' => out.push_str(&format!("\\u{:04x}", u32::from(letter))),
            _ => out.push(letter),
        }
    }
    out.push('"');
    out
}

/// A list of values in JSON.
pub(crate) fn list(values: impl IntoIterator<Item: ToString>) -> String {
    let values: Vec<String> = values.into_iter().map(|value| value.to_string()).collect();
    format!("[{}]", values.join(","))
}

/// An object of keys without special letters, and values in JSON.
pub(crate) fn map(fields: impl IntoIterator<Item = (String, String)>) -> String {
    let fields: Vec<String> = fields.into_iter().map(|(key, value)| format!("\"{key}\":{value}")).collect();
    format!("{{{}}}", fields.join(","))
}

pub(crate) fn object(fields: &[(&str, String)]) -> String {
    map(fields.iter().map(|(key, value)| ((*key).to_owned(), value.clone())))
}
