// Compiles the crates of the page for the browser, and writes their modules and types to src/core/pkg: the engine,
// and in `dicom/` the judge of DICOM series, which the page loads with the first DICOM file.
//
// Workers share the engine's memory, for which Rust's standard library is compiled anew: that is what RUSTC_BOOTSTRAP
// and `build-std` are for. None of its features is needed: a panic ends the module at once and leaves no trace.
// Without `panic=immediate-abort` the modules are 5 % larger.
import { spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, renameSync, rmSync, statSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const web = dirname(dirname(fileURLToPath(import.meta.url)));
const root = dirname(web);
const target = 'wasm32-unknown-unknown';
/** Small modules take minutes to link; for trying things out `LUMENCUT_WASM_PROFILE=checks` compiles quickly. */
const profile = process.env.LUMENCUT_WASM_PROFILE ?? 'wasm';
const pkg = join(web, 'src/core/pkg');
/** One set of flags for both modules, so that the standard library is compiled once; how the engine shares its memory is said to the
 * linker by its build script. */
const flags = [
  '-Zunstable-options',
  '-Cpanic=immediate-abort',
  '-Ctarget-feature=+atomics,+bulk-memory,+simd128',
];
const modules = [
  { crate: 'lumencut-wasm', folder: pkg, name: 'lumencut' },
  { crate: 'lumencut-dicom-wasm', folder: join(pkg, 'dicom'), name: 'lumencut_dicom' },
];

/** Runs a command in the repository; the build ends where it fails. */
function run(command, commandArguments, environment = {}) {
  const done = spawnSync(command, commandArguments, {
    cwd: root,
    env: { ...process.env, ...environment },
    stdio: 'inherit',
  });
  if (done.status !== 0) {
    console.error(`wasm: ${command} ${commandArguments[0]} did not succeed`, done.error?.message ?? '');
    process.exit(done.status ?? 1);
  }
}

/** Compiles a crate for the browser, and writes its module to a folder. */
function build({ crate, folder, name }) {
  run(
    'cargo',
    [
      ...['build', '--locked', '--quiet', '--package', crate, '--lib', '--profile', profile],
      ...['--target', target, '--target-dir', 'target', '-Z', 'build-std=std', '-Z', 'build-std-features='],
    ],
    { RUSTC_BOOTSTRAP: '1', CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUSTFLAGS: flags.join(' ') },
  );
  const compiled = join(root, 'target', target, profile, `${crate.replaceAll('-', '_')}.wasm`);
  const fresh = join(root, 'target/page-module');
  rmSync(fresh, { recursive: true, force: true });
  mkdirSync(fresh, { recursive: true });
  run('cargo', [...bindings, '--', compiled, fresh, name]);
  rmSync(folder, { recursive: true, force: true });
  renameSync(fresh, folder);
  const module = join(folder, `${name}_bg.wasm`);
  if (!existsSync(module)) {
    console.error(`wasm: found no ${module} after the build`);
    process.exit(1);
  }
  console.log(`wasm: ${crate} ${(statSync(module).size / 1e6).toFixed(2)} MB`);
}

const bindings = [
  'run',
  '--locked',
  '--quiet',
  '--manifest-path',
  'xtask/Cargo.toml',
  '--target-dir',
  'target/xtask',
];
modules.forEach(build);
