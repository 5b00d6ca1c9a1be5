//! Strips comments from the shaders that a browser loads; `shaders.rs` includes the result.

use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    println!("cargo:rerun-if-changed=src");
    if env::var("CARGO_CFG_TARGET_ARCH").as_deref() == Ok("wasm32") {
        let out = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
        for folder in ["math", "stages"] {
            shorten(&Path::new("src").join(folder), &out.join(folder))?;
        }
    }
    Ok(())
}

/// Writes the shaders of a folder without indentation and without comments other than imports.
fn shorten(from: &Path, to: &Path) -> io::Result<()> {
    fs::create_dir_all(to)?;
    for entry in fs::read_dir(from)? {
        let path = entry?.path();
        if path.extension().is_some_and(|ending| ending == "wgsl") {
            let text = fs::read_to_string(&path)?;
            let lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
            let kept = lines.filter(|line| !line.starts_with("//") || line.starts_with("// import "));
            let short: Vec<&str> =
                kept.map(|line| if line.starts_with("//") { line } else { code(line) }).collect();
            fs::write(to.join(path.file_name().unwrap_or_default()), short.join("\n"))?;
        }
    }
    Ok(())
}

/// Removes the comment at the end of a line; WGSL has no string literals that could hold `//`.
fn code(line: &str) -> &str {
    line.split("//").next().unwrap_or(line).trim_end()
}
