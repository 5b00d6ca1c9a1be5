//! Assembles shaders from modules and their imports.

use lumencut_core::shaders::{SHADERS, Shader};

const IMPORT: &str = "// import ";

/// The WGSL of the module `room`, preceded by that of all modules it imports, each once.
///
/// # Panics
/// For a module without a shader; a test assembles all of them.
pub fn assemble(room: &str) -> String {
    assemble_from(SHADERS, room)
}

pub(crate) fn assemble_from(shaders: &[Shader], room: &str) -> String {
    let mut done = Vec::new();
    let mut text = String::new();
    append(shaders, room, &mut done, &mut text);
    text
}

fn append(shaders: &[Shader], room: &str, done: &mut Vec<String>, text: &mut String) {
    if done.iter().any(|other| other == room) {
        return;
    }
    done.push(room.to_owned());
    let Some(shader) = shaders.iter().find(|shader| shader.room == room) else {
        panic!("no shader for the room {room}");
    };
    for import in shader.text.lines().filter_map(|line| line.strip_prefix(IMPORT)) {
        append(shaders, import.trim(), done, text);
    }
    text.push_str(shader.text);
    text.push('\n');
}
