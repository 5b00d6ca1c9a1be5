//! `xtask MODULE FOLDER NAME`: converts a WebAssembly module compiled by cargo for the browser. It writes `NAME_bg.wasm`, `NAME.js`
//! and `NAME.d.ts`.

use std::process::ExitCode;

use wasm_bindgen_cli_support::Bindgen;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [module, folder, name] = &arguments[..] else {
        eprintln!("xtask: found {} arguments; expected the module, the folder and the name", arguments.len());
        return ExitCode::FAILURE;
    };
    let mut bindgen = Bindgen::new();
    bindgen.input_path(module).out_name(name).typescript(true).omit_default_module_path(false);
    let web = bindgen.web(true).map(|web| web.remove_name_section(true).remove_producers_section(true));
    match web.and_then(|web| web.generate(folder)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("xtask: {error:#}");
            ExitCode::FAILURE
        }
    }
}
