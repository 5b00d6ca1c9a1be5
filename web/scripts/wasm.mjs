// Compiles the crates of the page to src/core/pkg: the engine, and in `dicom/`, `volumes/` and `packed/` modules that are
// loaded on demand.
// Workers share the engine's memory, so Rust's standard library is recompiled (RUSTC_BOOTSTRAP, `build-std`).
// Without `panic=immediate-abort`, which ends the module at a panic, the modules would be 5 % larger.
import { spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, renameSync, rmSync, statSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const web = dirname(dirname(fileURLToPath(import.meta.url)));
const root = dirname(web);
const target = 'wasm32-unknown-unknown';
/** Release modules take minutes to link; `LUMENCUT_WASM_PROFILE=checks` compiles quickly. */
const profile = process.env.LUMENCUT_WASM_PROFILE ?? 'wasm';
const pkg = join(web, 'src/core/pkg');
/** The same flags for all modules, so that the standard library is compiled once. */
const flags = [
  '-Zunstable-options',
  '-Cpanic=immediate-abort',
  '-Ctarget-feature=+atomics,+bulk-memory,+simd128',
];
const modules = [
  { crate: 'lumencut-wasm', folder: pkg, name: 'lumencut' },
  { crate: 'lumencut-dicom-wasm', folder: join(pkg, 'dicom'), name: 'lumencut_dicom' },
  { crate: 'lumencut-volumes-wasm', folder: join(pkg, 'packed'), name: 'lumencut_packed' },
];
/** Without decoders: a third smaller, for files that are not compressed, or that the browser unpacks. */
const small = { crate: 'lumencut-volumes-wasm', folder: join(pkg, 'volumes'), name: 'lumencut_volumes' };

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

/** Compiles these crates at once, so that shared parts compile once. */
function compile(crates, ...more) {
  const packages = crates.flatMap(({ crate }) => ['--package', crate]);
  run(
    'cargo',
    [
      ...['build', '--locked', '--quiet', ...packages, '--lib', '--profile', profile, ...more],
      ...['--target', target, '--target-dir', 'target', '-Z', 'build-std=std', '-Z', 'build-std-features='],
    ],
    { RUSTC_BOOTSTRAP: '1', CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUSTFLAGS: flags.join(' ') },
  );
}

/** Writes the module of a crate in the form that browsers load. */
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
compile(modules);
modules.forEach(write);
compile([small], '--no-default-features');
write(small);
