//! The table of labels that TotalSegmentator writes into NIfTI files as an extension of the header.

use crate::text::printable;

const MOST_DIGITS: usize = 9;

/// Whether extensions follow a header of this length; the four bytes after it state this.
pub(crate) fn has_extensions(head: &[u8], length: usize) -> bool {
    head.len() >= length + 4 && head[length] != 0
}

/// The names of labels in the extensions that follow a header of this length.
pub(crate) fn names_in(head: &[u8], length: usize, is_big: bool) -> Vec<(i64, String)> {
    let mut names = Vec::new();
    let mut start = length + 4;
    while let Some(stated) = head.get(start..start + 8) {
        let stated = [stated[0], stated[1], stated[2], stated[3]];
        let size = if is_big { u32::from_be_bytes(stated) } else { u32::from_le_bytes(stated) };
        let end = start.saturating_add(size as usize).min(head.len());
        if end > start + 8 {
            let text = String::from_utf8_lossy(&head[start + 8..end]);
            add_labels(&text, &mut names);
        }
        start = start.saturating_add((size as usize).max(8));
    }
    names
}

fn add_labels(text: &str, names: &mut Vec<(i64, String)>) {
    for (place, found) in text.match_indices("<Label") {
        let rest = &text[place + found.len()..];
        let Some((value, name)) = label_in(rest) else { continue };
        match names.iter_mut().find(|(known, _)| *known == value) {
            Some((_, known)) => *known = name,
            None => names.push((value, name)),
        }
    }
}

fn label_in(rest: &str) -> Option<(i64, String)> {
    if rest.starts_with(|letter: char| letter.is_ascii_alphanumeric() || letter == '_') {
        return None;
    }
    let (inside, text) = rest.split_once('>')?;
    let value = inside.match_indices("Key=\"").find_map(|(at, key)| {
        let is_word = inside[..at].ends_with(|letter: char| letter.is_ascii_alphanumeric() || letter == '_');
        let (digits, _) = inside[at + key.len()..].split_once('"')?;
        let plain = digits.strip_prefix('-').unwrap_or(digits);
        let is_number = (1..=MOST_DIGITS).contains(&plain.len()) && plain.bytes().all(|d| d.is_ascii_digit());
        (is_number && !is_word).then(|| digits.parse().ok())?
    })?;
    let text = text.strip_prefix("<![CDATA[").unwrap_or(text);
    let name = text.split(['<', ']']).next().unwrap_or("").trim();
    (!name.is_empty()).then(|| (value, printable(name)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_of_an_extension_have_their_names() {
        let text = "<LabelTable><Label Key=\"1\" Red=\"0\"><![CDATA[aorta]]></Label><Label Key=\"-2\"> vein </Label>\
                    <Label Key=\"1\">trunk</Label><Label Key=\"x\">no</Label><Labels Key=\"3\">no</Labels>";
        let mut head = vec![0; 352];
        head[348] = 1;
        head.extend_from_slice(&(text.len() as u32 + 8).to_le_bytes());
        head.extend_from_slice(&[0; 4]);
        head.extend_from_slice(text.as_bytes());
        assert!(has_extensions(&head, 348));
        assert_eq!(names_in(&head, 348, false), [(1, "trunk".into()), (-2, "vein".into())]);
        assert_eq!(names_in(&head[..400], 348, true), []);
    }
}
