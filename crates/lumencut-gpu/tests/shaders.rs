//! Every shader is valid together with its imports, and stays within the limits of every GPU.

use std::path::{Path, PathBuf};

use lumencut_core::shaders::SHADERS;
use lumencut_gpu::stage::assemble;
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{AddressSpace, GlobalVariable, Handle, Module};

/// Modules without a Rust file of the same name; the view corresponds to the core's camera.
const WITHOUT_RUST: [&str; 1] = ["math/view"];

/// The module that is not in the table of stages but runs as one.
const PROJECTION: &str = "math/projection";

/// The number of storage buffers per stage that every GPU allows.
const MOST_STORAGE: usize = 8;

fn parse(room: &str) -> (Module, ModuleInfo) {
    parsed(room, &assemble(room))
}

fn parsed(room: &str, text: &str) -> (Module, ModuleInfo) {
    let module = naga::front::wgsl::parse_str(text)
        .unwrap_or_else(|error| panic!("{room}: {}", error.emit_to_string(text)));
    let info = Validator::new(ValidationFlags::all(), Capabilities::empty())
        .validate(&module)
        .unwrap_or_else(|error| panic!("{room}: {}", error.emit_to_string(text)));
    (module, info)
}

fn core_sources() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../lumencut-core/src")
}

fn rooms_on_disk(folder: &Path, root: &Path, rooms: &mut Vec<String>) {
    for entry in std::fs::read_dir(folder).expect("the core's sources") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            rooms_on_disk(&path, root, rooms);
        } else if path.extension().is_some_and(|extension| extension == "wgsl") {
            let room = path.with_extension("");
            let parts = room.strip_prefix(root).expect("below the root").iter();
            rooms.push(parts.map(|part| part.to_string_lossy()).collect::<Vec<_>>().join("/"));
        }
    }
}

#[test]
fn every_shader_is_valid() {
    assert!(SHADERS.len() >= 6, "{} shaders", SHADERS.len());
    for shader in SHADERS {
        parse(shader.room);
    }
}

/// Drawing on a canvas is no stage of the core, so its shader belongs to this crate.
#[test]
fn the_shader_of_the_screen_is_valid() {
    parsed("screen", include_str!("../src/screen.wgsl"));
}

/// Browsers' compilers require parentheses when a bit operator is next to a shift; naga does not.
#[test]
fn shifts_stand_in_parentheses() {
    let screen = include_str!("../src/screen.wgsl");
    for text in SHADERS.iter().map(|shader| shader.text).chain([screen]) {
        for line in text.lines().map(|line| line.split("//").next().unwrap_or(line)) {
            assert!(!mixes_bits_and_shifts(line), "{line}");
        }
    }
    assert!(mixes_bits_and_shifts("a | b << 8u"));
    assert!(!mixes_bits_and_shifts("a | (b << 8u)") && !mixes_bits_and_shifts("a |= f(b, c) << (d + 1u)"));
}

/// Whether a single pair of parentheses holds both a shift and `&`, `|` or `^`.
fn mixes_bits_and_shifts(line: &str) -> bool {
    let words = line.replace("&&", " ").replace("||", " ").replace("|=", " ").replace("&=", " ");
    let mut open = vec![(false, false)];
    let mut before = ' ';
    for sign in words.chars() {
        match sign {
            '(' | '[' => open.push((false, false)),
            ')' | ']' if open.len() > 1 => drop(open.pop()),
            ',' | ';' => open.last_mut().map_or((), |level| *level = (false, false)),
            '&' | '|' | '^' => open.last_mut().map_or((), |level| level.0 = true),
            '<' | '>' if before == sign => open.last_mut().map_or((), |level| level.1 = true),
            _ => {}
        }
        if open.last().is_some_and(|level| level.0 && level.1) {
            return true;
        }
        before = sign;
    }
    false
}

#[test]
fn the_table_holds_every_file_once() {
    let root = core_sources();
    let mut on_disk = Vec::new();
    rooms_on_disk(&root, &root, &mut on_disk);
    on_disk.sort();
    let mut listed: Vec<_> = SHADERS.iter().map(|shader| shader.room).collect();
    listed.sort_unstable();
    assert_eq!(listed, on_disk);
}

#[test]
fn every_shader_lies_beside_its_rust() {
    for shader in SHADERS {
        let rust = core_sources().join(shader.room).with_extension("rs");
        assert_eq!(rust.is_file(), !WITHOUT_RUST.contains(&shader.room), "{}", rust.display());
    }
}

#[test]
fn every_stage_has_an_entry_point_of_its_name_and_no_other_room_has_any() {
    for shader in SHADERS {
        let (module, _) = parse(shader.room);
        let entries: Vec<_> = module.entry_points.iter().map(|entry| entry.name.as_str()).collect();
        let is_stage = shader.room.starts_with("stages/") || shader.room.starts_with("reformations/");
        let name = shader.room.rsplit('/').next().filter(|_| is_stage);
        match name.or(Some("projection").filter(|_| shader.room == PROJECTION)) {
            Some(name) => assert!(entries.contains(&name), "{}: {entries:?}", shader.room),
            None => assert!(entries.is_empty(), "{}: {entries:?}", shader.room),
        }
    }
}

#[test]
fn bindings_are_the_first_of_group_0_with_few_storage_buffers() {
    for shader in SHADERS {
        let (module, info) = parse(shader.room);
        for (n, entry) in module.entry_points.iter().enumerate() {
            let name = format!("{} of {}", entry.name, shader.room);
            let used =
                |(handle, _): &(Handle<GlobalVariable>, _)| !info.get_entry_point(n)[*handle].is_empty();
            let bound: Vec<_> = module
                .global_variables
                .iter()
                .filter(used)
                .filter_map(|(_, global)| Some((global.binding?, global)))
                .collect();
            assert!(bound.iter().all(|(place, _)| place.group == 0), "{name}");
            let mut bindings: Vec<_> = bound.iter().map(|(place, _)| place.binding).collect();
            bindings.sort_unstable();
            // These entry points need no view, and do not use the first bindings.
            let first = match entry.name.as_str() {
                "bundle" => 2,
                "enclose" | "wall" => 1,
                _ => 0,
            };
            assert!(
                bindings.iter().copied().eq(first..first + bindings.len() as u32),
                "{name}: {bindings:?}"
            );
            assert!(bindings.len() >= 2, "{name}: {bindings:?}");
            let view = bound.iter().find(|(place, _)| place.binding == 0).map(|(_, global)| global);
            let expected = Some("view").filter(|_| first == 0);
            assert_eq!(view.and_then(|view| view.name.as_deref()), expected, "{name}");
            let is_storage = |space: AddressSpace| matches!(space, AddressSpace::Storage { .. });
            let storage = bound.iter().filter(|(_, global)| is_storage(global.space)).count();
            assert!(storage <= MOST_STORAGE, "{name}: {storage} storage buffers");
            let threads: u32 = entry.workgroup_size.iter().product();
            assert!((1..=256).contains(&threads), "{name}: {threads} threads in a group");
        }
    }
}

/// The words in WGSL code, without comments, that stand for a non-finite number.
fn not_finite(text: &str) -> Vec<&str> {
    text.lines()
        .flat_map(|line| line.split("//").next())
        .flat_map(|code| code.split(|c: char| !c.is_alphanumeric() && c != '_'))
        .filter(|word| {
            let word = word.to_lowercase();
            ["inf", "nan", "infinity", "isinf", "isnan", "is_inf", "is_nan"].contains(&word.as_str())
        })
        .collect()
}

#[test]
fn no_shader_speaks_of_inf_or_nan() {
    for shader in SHADERS {
        assert!(!shader.text.contains("/*"), "{}: comments begin with //", shader.room);
        assert_eq!(not_finite(shader.text), [""; 0], "{}", shader.room);
    }
    let text = "let a = inf; // NaN\nif isNan(b) || b == -INF { information(nan_count); }";
    assert_eq!(not_finite(text), ["inf", "isNan", "INF"]);
}
