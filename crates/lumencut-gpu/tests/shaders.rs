//! Every shader parses and validates, with the rooms that it imports.

use lumencut_core::shaders::SHADERS;
use lumencut_gpu::shader::assemble;
use naga::valid::{Capabilities, ValidationFlags, Validator};

#[test]
fn every_shader_is_valid() {
    assert!(SHADERS.len() >= 3, "{} shaders", SHADERS.len());
    for shader in SHADERS {
        let text = assemble(shader.room);
        let module = naga::front::wgsl::parse_str(&text)
            .unwrap_or_else(|error| panic!("{}: {}", shader.room, error.emit_to_string(&text)));
        Validator::new(ValidationFlags::all(), Capabilities::empty())
            .validate(&module)
            .unwrap_or_else(|error| panic!("{}: {}", shader.room, error.emit_to_string(&text)));
    }
}
