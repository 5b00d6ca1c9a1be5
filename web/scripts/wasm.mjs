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

/** Compiles the crates for the browser, all at once: what they share is compiled once, and one is linked beside the other. */
function compile() {
  const packages = modules.flatMap(({ crate }) => ['--package', crate]);
  run(
    'cargo',
    [
      ...['build', '--locked', '--quiet', ...packages, '--lib', '--profile', profile],
      ...['--target', target, '--target-dir', 'target', '-Z', 'build-std=std', '-Z', 'build-std-features='],
    ],
    { RUSTC_BOOTSTRAP: '1', CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUSTFLAGS: flags.join(' ') },
  );
}

/** Writes the module of a compiled crate to its folder, as a browser loads it. */
function write({ crate, folder, name }) {
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
compile();
modules.forEach(write);
