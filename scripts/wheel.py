"""Build the packages of a release into dist/ and try them: a wheel for each Linux machine, and the sources.

maturin links the wheels against glibc 2.17 with zig and checks their symbols. No tool then installs the wheel
of this machine and one built from the sources in an empty environment, and runs `lumencut doctor` there, with
neither Rust nor Node. On other systems there is one wheel. `make wheel` runs it and installs the tools.
"""

from __future__ import annotations

import os
import platform
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Sequence
from email.parser import BytesParser
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BIN = ROOT / ".venv/bin"
DIST = ROOT / "dist"
LOCK = ROOT / "requirements/runtime.lock"
#: Files of the viewer's page that a wheel must contain.
PAGE = tuple(f"lumencut/viewer/page/{name}" for name in ("index.html", "THIRD-PARTY-NOTICES.txt"))
LICENCES = ("LICENSE-MIT", "LICENSE-APACHE", "THIRD-PARTY-LICENSES")
MACHINES = ("x86_64", "aarch64")


class PackageError(Exception):
    """An invalid package."""


def run(*command: str | Path) -> None:
    """Run a tool of the environment; a build takes minutes."""
    print("\n==", *command, flush=True)
    environment = {"PATH": f"{BIN}{os.pathsep}{os.environ['PATH']}", "CARGO_TARGET_DIR": str(ROOT / "target")}
    subprocess.run((BIN / command[0], *command[1:]), cwd=ROOT, env=os.environ | environment, check=True)


def only(folder: Path, pattern: str) -> Path:
    """The only file of a folder that matches the pattern."""
    found = sorted(folder.glob(pattern))
    if len(found) != 1:
        raise PackageError(f"found {[path.name for path in found]}; expected one {pattern}")
    return found[0]


def build_wheels(folder: Path) -> list[Path]:
    """A wheel for each kind of Linux machine; elsewhere one for this machine."""
    release = ("maturin", "build", "--release", "--locked", "--out", folder)
    if sys.platform != "linux":
        run(*release)
        return [only(folder, "*.whl")]
    for machine in MACHINES:
        target = f"{machine}-unknown-linux-gnu"
        run(*release, "--zig", "--compatibility", "manylinux_2_17", "--target", target)
    return [only(folder, f"*-cp311-abi3-manylinux_2_17_{machine}.*whl") for machine in MACHINES]


def check_wheel(wheel: Path) -> None:
    """Check that the wheel supports its stated Pythons and contains licences and page."""
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
        (folder,) = {name.partition("/")[0] for name in names if ".dist-info/" in name}
        stated = BytesParser().parsebytes(archive.read(f"{folder}/METADATA")).get_all("License-File")
        kept = {name: archive.read(f"{folder}/licenses/{name}") for name in stated or []}
    if set(kept) != set(LICENCES):
        raise PackageError(f"{wheel.name}: found the licences {sorted(kept)}; expected {sorted(LICENCES)}")
    if absent := [name for name in PAGE if name not in names]:
        raise PackageError(f"{wheel.name}: found no {' and no '.join(absent)}; expected the viewer's page")
    for name, text in kept.items():
        if text != (ROOT / name).read_bytes():
            raise PackageError(f"{wheel.name}: {name} is not the repository's")
    if "-cp311-abi3-" not in wheel.name:
        raise PackageError(f"{wheel.name}: expected the stable ABI of Python 3.11 (cp311-abi3)")


def run_apart(folder: Path, *command: str | Path) -> None:
    """Run a command of an environment, in its folder, without the repository, Rust and Node."""
    outside = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    program = folder / "bin" / str(command[0])
    outside["PATH"] = str(program.parent)
    subprocess.run((program, *command[1:]), cwd=folder, env=outside, check=True)


def try_out(wheels: Sequence[Path], folder: Path) -> None:
    """Install each wheel in an empty environment, where its doctor renders a phantom."""
    subprocess.run((sys.executable, "-m", "venv", folder), check=True)
    # Without hashes: with them pip would require one for the wheel too.
    locked = folder / "locked.txt"
    locked.write_text("\n".join(re.findall(r"^\w.*?(?= \\)", LOCK.read_text("utf-8"), re.MULTILINE)), "utf-8")
    pip = ("python", "-m", "pip", "--disable-pip-version-check")
    for wheel in wheels:
        print(f"\n== trial of {wheel.name}", flush=True)
        run_apart(folder, *pip, "install", "--quiet", "--force-reinstall", "--constraint", locked, wheel)
        run_apart(folder, *pip, "check")
        run_apart(folder, "lumencut", "doctor")


def package(folder: Path) -> None:
    """Build and check everything in a folder, then put it into dist/."""
    run("maturin", "sdist", "--out", folder)
    sources = only(folder, "*.tar.gz")
    wheels = build_wheels(folder)
    pip = ("python", "-m", "pip", "--disable-pip-version-check", "wheel", "--quiet")
    run(*pip, "--no-deps", "--no-build-isolation", "--wheel-dir", folder / "built", sources)
    from_sources = only(folder / "built", "*.whl")
    for wheel in (*wheels, from_sources):
        check_wheel(wheel)
    native = [wheel for wheel in wheels if sys.platform != "linux" or platform.machine() in wheel.name]
    try_out([*native, from_sources], folder / "environment")
    DIST.mkdir(exist_ok=True)
    for old in DIST.glob("lumencut-*"):
        old.unlink()
    for file in (sources, *wheels):
        shutil.move(file, DIST / file.name)
        print(f"{(DIST / file.name).stat().st_size:>10,}  {file.name}")


def main() -> None:
    """Make the packages, or report what is wrong."""
    try:
        with tempfile.TemporaryDirectory() as folder:
            package(Path(folder).resolve())
    except (PackageError, OSError, subprocess.CalledProcessError) as error:
        sys.exit(f"packages: {error}")


if __name__ == "__main__":
    main()
