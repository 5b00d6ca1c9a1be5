//! Every constant of a shader is bit-identical to the Rust constant of the same name. The few constants that
//! only shaders have are listed with the reason.

use std::collections::BTreeMap;
use std::f32::consts;

use lumencut_core::math::blocks::Range;
use lumencut_core::math::context_parameters::Gathering;
use lumencut_core::math::reduce::Reduction;
use lumencut_core::math::{
    accumulate, blocks, cell_walk, cubic, hierarchy, lanes, leaps, light, projection, ray, sampling,
    thickness, transfer, tube, walls,
};
use lumencut_core::settings;
use lumencut_core::shaders::{SHADERS, Shader};
use lumencut_core::stages::{body, composite, context, depth, focus, leap, occlusion, silhouette};
use naga::{Expression, Handle, Literal, Module};

use crate::cut_surface;
use crate::stage::assemble_from;

type Name = (String, String);

trait Numbers {
    fn numbers(&self) -> Vec<f64>;
}

impl Numbers for u32 {
    fn numbers(&self) -> Vec<f64> {
        vec![f64::from(*self)]
    }
}

impl Numbers for usize {
    fn numbers(&self) -> Vec<f64> {
        vec![*self as f64]
    }
}

impl Numbers for f32 {
    fn numbers(&self) -> Vec<f64> {
        vec![f64::from(*self)]
    }
}

impl Numbers for f64 {
    fn numbers(&self) -> Vec<f64> {
        (*self as f32).numbers()
    }
}

impl<const N: usize> Numbers for [f32; N] {
    fn numbers(&self) -> Vec<f64> {
        self.iter().flat_map(Numbers::numbers).collect()
    }
}

impl Numbers for Range {
    fn numbers(&self) -> Vec<f64> {
        [self.low, self.high].numbers()
    }
}

/// Lists constants of Rust, by the shader module that has a constant of the same name.
macro_rules! in_rust {
    ($($room:literal: $($constant:path),+;)*) => {
        BTreeMap::from([$($((name($room, stringify!($constant)), $constant.numbers())),+),*])
    };
}

fn name(room: &str, path: &str) -> Name {
    let last = path.rsplit("::").next().unwrap_or(path);
    (room.to_owned(), last.trim().to_owned())
}

fn in_rust() -> BTreeMap<Name, Vec<f64>> {
    let mut all = in_rust! {
        "math/accumulate": accumulate::OPAQUE;
        "math/blocks": blocks::SIDE_BITS, Range::ALL;
        "math/lanes": lanes::FAN, lanes::UNSET, lanes::ABSENT, lanes::FAR, lanes::EXCLUDED, hierarchy::NO_SLOT,
            blocks::HUGE;
        "math/leaps": leaps::TO_THE_RIGHT, leaps::DOWNWARDS, leaps::LINE_TO_THE_RIGHT, leaps::LINE_DOWNWARDS,
            leaps::LUMEN, leaps::WALL;
        "math/levels": settings::MAX_LEVELS;
        "math/light": light::AMBIENT, light::DIFFUSE, light::SPECULAR, light::STEEPEST, light::UNSHADED;
        "math/projection": projection::COLLINEAR_LENGTH, cut_surface::POINT_THREADS;
        "math/ray": ray::WHOLE, ray::NONE, ray::NEVER, ray::SPARE;
        "math/sampling": sampling::POSITION_ROUNDING;
        "math/thickness": thickness::ROOT_HALF, consts::LOG2_E, consts::LN_2;
        "math/tile": cut_surface::QUAD, cut_surface::TILES, cut_surface::TILES_ACROSS;
        "math/transfer": transfer::INVISIBLE;
        "math/tube": tube::AROUND, tube::NEWTON, tube::SHORTEST, tube::LONGEST, tube::REFINED, tube::EXACT, tube::MAX_STEPS, tube::LEAST;
        "math/walls": walls::MAX_LEAN;
        "stages/body": body::COLOR, body::EVERYWHERE, body::GLOW, body::LINE, body::GLOW_MM, consts::LOG2_E, ray::NONE;
        "stages/composite": composite::RIM_FADES;
        "stages/context": context::IN_FRONT;
        "stages/depth": depth::CHOSEN_GAP, depth::WALL_GAP;
        "stages/focus": focus::HALO_MM, focus::SHADE_FADE_MM, consts::LOG2_E;
        "stages/leap": depth::CHOSEN_GAP, depth::WALL_GAP, leap::SMALLEST_LEAP, leap::ALONG_VIEW, leap::MOST_DIAMETERS;
        "stages/occlusion": occlusion::FIRST_MM, occlusion::FULL_MM, occlusion::GAIN;
        "stages/silhouette": silhouette::ZONE_BORDER, silhouette::STEEPEST;
        "math/cell_walk": cell_walk::NO_MEETING, cell_walk::ALONG_PLANE;
        "math/cubic": cubic::TINY;
    };
    let gatherings = [
        ("BLEND", Gathering::Blend),
        ("BRIGHTEST", Gathering::Brightest),
        ("DARKEST", Gathering::Darkest),
        ("AVERAGE", Gathering::Average),
    ];
    all.extend(
        gatherings.map(|(code, gathering)| (name("stages/context", code), gathering.code().numbers())),
    );
    let reductions =
        [("MEAN", Reduction::Mean), ("LARGEST", Reduction::Largest), ("SMALLEST", Reduction::Smallest)];
    all.extend(
        reductions.map(|(code, reduction)| (name("stages/surface", code), reduction.code().numbers())),
    );
    all
}

/// The constants that only shaders have, by module, with the reason.
const ONLY_IN_SHADERS: [(&str, &str, &str); 15] = [
    ("math/blocks", "FARTHEST", "rays of the CPU skip whole segments and count no samples"),
    ("math/projection", "SPAN_THREADS", "the threads of a group"),
    ("math/projection", "LEVEL_THREADS", "the threads of a group"),
    ("math/projection", "NOWHERE", "where a group of threads has found nothing yet"),
    ("math/tile", "MAX_ACROSS", "the size of an array of a thread"),
    ("math/tile", "MAX_ROWS", "the size of an array of a thread"),
    ("math/tile", "MAX_QUADS", "the size of an array of a thread"),
    ("math/trace", "RUN", "how often a thread looks at the blocks, which changes no picture"),
    ("math/tube", "NOTHING", "a kind of `Met`"),
    ("math/tube", "WALL", "a kind of `Met`"),
    ("math/tube", "OPENING", "a kind of `Met`"),
    ("math/window", "FAR_INTENSITY", "on the CPU a product may be infinite"),
    ("math/reduce", "STRETCH", "how often a thread looks at the blocks, which changes no picture"),
    ("math/reduce", "FEW", "the CPU adds up in float64"),
    ("stages/surface", "STRETCH", "how many cells a thread follows in a row, which changes no picture"),
];

/// The constants that a module declares outside its functions.
fn declared(shader: &Shader) -> Vec<String> {
    let lines = shader.text.lines().filter(|line| line.trim_start().starts_with("const "));
    let name = |line: &str| {
        let rest = line.strip_prefix("const ");
        let rest = rest.unwrap_or_else(|| panic!("{}: '{line}' is within a function", shader.room));
        rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()
    };
    lines.map(name).collect()
}

fn numbers(module: &Module, expression: Handle<Expression>) -> Vec<f64> {
    match &module.global_expressions[expression] {
        Expression::Literal(Literal::F32(number)) => vec![f64::from(*number)],
        Expression::Literal(Literal::U32(number)) => vec![f64::from(*number)],
        Expression::Literal(Literal::I32(number)) => vec![f64::from(*number)],
        Expression::Constant(constant) => numbers(module, module.constants[*constant].init),
        Expression::Compose { components, .. } => {
            components.iter().flat_map(|component| numbers(module, *component)).collect()
        }
        other => panic!("not a number: {other:?}"),
    }
}

fn in_shaders(shaders: &[Shader]) -> BTreeMap<Name, Vec<f64>> {
    let mut found = BTreeMap::new();
    for shader in shaders {
        let module = naga::front::wgsl::parse_str(&assemble_from(shaders, shader.room)).unwrap();
        for constant in declared(shader) {
            let has_name = |of: &naga::Constant| of.name.as_ref() == Some(&constant);
            let declaration = module.constants.iter().find(|(_, of)| has_name(of));
            let (_, declaration) =
                declaration.unwrap_or_else(|| panic!("{}: {constant} needs a type", shader.room));
            found.insert(name(shader.room, &constant), numbers(&module, declaration.init));
        }
    }
    found
}

/// The constants of shaders that differ from Rust's and are not listed in `alone`, one line each.
fn differences(
    shaders: &BTreeMap<Name, Vec<f64>>,
    rust: &BTreeMap<Name, Vec<f64>>,
    alone: &[Name],
) -> Vec<String> {
    let mut lines = Vec::new();
    for (name, value) in shaders.iter().filter(|(name, _)| !alone.contains(name)) {
        match rust.get(name) {
            Some(same) if same == value => {}
            other => lines.push(format!("{name:?} is {value:?} in WGSL and {other:?} in Rust")),
        }
    }
    let is_gone = |name: &&Name| !shaders.contains_key(*name);
    lines.extend(rust.keys().chain(alone).filter(is_gone).map(|name| format!("{name:?} is not in WGSL")));
    lines.extend(alone.iter().filter(|name| rust.contains_key(*name)).map(|name| format!("{name:?} twice")));
    lines
}

fn alone() -> Vec<Name> {
    ONLY_IN_SHADERS.iter().map(|(room, constant, _)| name(room, constant)).collect()
}

#[test]
fn every_constant_is_that_of_rust() {
    let shaders = in_shaders(SHADERS);
    assert!(shaders.len() > 40, "{} constants", shaders.len());
    let found = differences(&shaders, &in_rust(), &alone());
    assert!(found.is_empty(), "add to `in_rust`, or with a reason to `ONLY_IN_SHADERS`: {found:#?}");
}

#[test]
fn every_difference_is_seen() {
    const ROOMS: [Shader; 2] = [
        Shader { room: "low", text: "const A: f32 = 1e-3;\nconst B = 2u;\n" },
        Shader { room: "top", text: "// import low\nconst C = vec2f(-A, A);\nconst D: f32 = 1.0 - A;\n" },
    ];
    let shaders = in_shaders(&ROOMS);
    let rust = BTreeMap::from([
        (name("low", "lower::A"), 1e-3f64.numbers()),
        (name("low", "B"), 2usize.numbers()),
        (name("top", "C"), [-1e-3f32, 1e-3].numbers()),
    ]);
    let alone = [name("top", "D")];
    assert_eq!(differences(&shaders, &rust, &alone), [""; 0]);
    assert_eq!(differences(&shaders, &rust, &[]).len(), 1, "a constant that Rust lacks");
    for constant in rust.keys() {
        let mut other = rust.clone();
        other.entry(constant.clone()).and_modify(|value| value[0] = value[0].next_up());
        assert_eq!(differences(&shaders, &other, &alone).len(), 1, "another {constant:?}");
        let mut fewer = shaders.clone();
        fewer.remove(constant);
        assert_eq!(differences(&fewer, &rust, &alone).len(), 1, "without {constant:?}");
    }
    let twice = [name("top", "D"), name("low", "A")];
    assert_eq!(differences(&shaders, &rust, &twice).len(), 1, "in both lists");
}

#[test]
#[should_panic(expected = "within a function")]
fn a_constant_within_a_function_is_refused() {
    in_shaders(&[Shader { room: "room", text: "fn f() -> f32 {\n    const A = 1.0;\n    return A;\n}\n" }]);
}

#[test]
fn the_tile_fits_the_arrays_of_a_thread() {
    let shaders = in_shaders(SHADERS);
    let most = |constant| shaders[&name("math/tile", constant)][0] as usize;
    let fits = |[across, rows]: [usize; 2]| {
        across <= most("MAX_ACROSS") && rows <= most("MAX_ROWS") && across * rows <= most("MAX_QUADS")
    };
    for tile in [cut_surface::TILE_ON_SOFTWARE, cut_surface::TILE_ON_HARDWARE] {
        assert!(fits(tile), "{tile:?}");
    }
}
