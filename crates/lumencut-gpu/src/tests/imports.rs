//! Assembled shaders contain each module once, after its imports.

use lumencut_core::shaders::Shader;

use crate::stage::assemble_from;

const ROOMS: &[Shader] = &[
    Shader { room: "top", text: "// import left\n// import right\n// import left\nTOP" },
    Shader { room: "left", text: "// import base\nLEFT" },
    Shader { room: "right", text: "// import base\nRIGHT" },
    Shader { room: "base", text: "BASE" },
    Shader { room: "hen", text: "// import egg\nHEN" },
    Shader { room: "egg", text: "// import hen\nEGG" },
    Shader { room: "self", text: "// import self\nSELF" },
    Shader { room: "lost", text: "// import nowhere\nLOST" },
];

fn declarations(room: &str) -> Vec<String> {
    assemble_from(ROOMS, room).lines().filter(|line| !line.starts_with("//")).map(str::to_owned).collect()
}

#[test]
fn a_room_follows_what_it_imports_and_comes_once() {
    assert_eq!(declarations("top"), ["BASE", "LEFT", "RIGHT", "TOP"]);
    assert_eq!(declarations("base"), ["BASE"]);
}

#[test]
fn cycles_end() {
    assert_eq!(declarations("hen"), ["EGG", "HEN"]);
    assert_eq!(declarations("egg"), ["HEN", "EGG"]);
    assert_eq!(declarations("self"), ["SELF"]);
}

#[test]
#[should_panic(expected = "no shader for the room nowhere")]
fn an_unknown_import_is_refused() {
    declarations("lost");
}

#[test]
#[should_panic(expected = "no shader for the room stages/nowhere")]
fn an_unknown_room_is_refused() {
    crate::stage::assemble("stages/nowhere");
}
