//! Writes JSON; a library for this would be a third of the module.

/// A JSON string.
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

/// A JSON array of values that are JSON.
pub(crate) fn list(values: impl IntoIterator<Item: ToString>) -> String {
    let values: Vec<String> = values.into_iter().map(|value| value.to_string()).collect();
    format!("[{}]", values.join(","))
}

/// A JSON object of keys that need no escapes, and values that are JSON.
pub(crate) fn map(fields: impl IntoIterator<Item = (String, String)>) -> String {
    let fields: Vec<String> = fields.into_iter().map(|(key, value)| format!("\"{key}\":{value}")).collect();
    format!("{{{}}}", fields.join(","))
}

pub(crate) fn object(fields: &[(&str, String)]) -> String {
    map(fields.iter().map(|(key, value)| ((*key).to_owned(), value.clone())))
}
