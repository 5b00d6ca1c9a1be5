//! Formats generated TypeScript so that it is easy to read: one readonly field per line.

pub(super) fn comment(words: &str) -> String {
    format!("/**\n * {}\n */\n", words.replace('\n', "\n * "))
}

/// Puts each field on a line of its own, and each comment on a single line.
pub(super) fn pretty(types: &str) -> String {
    let mut made = String::new();
    let mut depth: usize = 0;
    let mut rest = types;
    let line = |made: &mut String, depth: usize| {
        made.truncate(made.trim_end_matches([' ', '\n']).len());
        made.push('\n');
        made.push_str(&"  ".repeat(depth));
    };
    while let Some(first) = rest.chars().next() {
        let length = first.len_utf8();
        if rest.starts_with("/**") {
            let length = rest.find("*/").map_or(rest.len(), |end| end + 2);
            let words: Vec<&str> =
                rest[3..length - 2].lines().map(|line| line.trim().trim_start_matches('*').trim()).collect();
            let words = words.join(" ");
            made.push_str(&format!("/** {} */", words.trim()));
            line(&mut made, depth);
            rest = rest[length..].trim_start();
            continue;
        }
        match first {
            '{' => {
                depth += 1;
                made.push('{');
                line(&mut made, depth);
                rest = rest[length..].trim_start();
                continue;
            }
            '}' => {
                depth -= 1;
                line(&mut made, depth);
                made.push('}');
            }
            ',' if depth > 0 && is_field(&made) => {
                made.push(';');
                line(&mut made, depth);
                rest = rest[length..].trim_start();
                continue;
            }
            other => made.push(other),
        }
        rest = &rest[length..];
    }
    made
}

/// Whether a comma after this text ends a field, and is not within a tuple or generic brackets.
fn is_field(made: &str) -> bool {
    let line = made.rsplit('\n').next().unwrap_or_default();
    let count = |signs: [char; 2]| line.chars().filter(|sign| signs.contains(sign)).count();
    count(['[', '[']) == count([']', ']']) && count(['<', '<']) == count(['>', '>'])
}

/// Makes fields, lists and tuples readonly, and names tuples of two and three numbers.
pub(super) fn with_readonly(types: &str) -> String {
    let line = |line: &str| {
        let bare = line.trim_start();
        if bare.starts_with("/**") {
            return line.to_owned();
        }
        let named = line.replace("[number, number, number]", "Vector").replace("[number, number]", "Pair");
        let lists = named.replace("Array<", "ReadonlyArray<").replace('[', "readonly [");
        let indent = &lists[..line.len() - bare.len()];
        let text = &lists[indent.len()..];
        let is_field = !indent.is_empty() && !text.starts_with('}');
        format!("{indent}{}{text}", if is_field { "readonly " } else { "" })
    };
    types.lines().map(line).collect::<Vec<_>>().join("\n") + "\n"
}
