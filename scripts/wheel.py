"""Build the packages of a release into dist/ and check them: a wheel for each Linux machine, and the sources.

The wheels run on any Linux with glibc 2.17 or newer; zig, which is a Python package, links them against that
version. Whatever can run here is tried: the wheel is installed in an empty environment with what it requires,
and renders a phantom outside the repository; the same is done with a wheel that is built from the sources.
Elsewhere than on Linux there is one wheel, for this machine. Run by `make wheel`, which installs the tools.
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
from dataclasses import dataclass
from email.parser import BytesParser
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BIN = ROOT / ".venv/bin"
DIST = ROOT / "dist"
#: Where the pictures of the trials are kept, to be looked at.
PICTURES = ROOT / "target/wheel"
LOCK = ROOT / "requirements/runtime.lock"
PAGE = tuple(f"lumencut/viewer/page/{name}" for name in ("index.html", "THIRD-PARTY-NOTICES.txt"))
LICENCES = ("LICENSE-MIT", "LICENSE-APACHE", "THIRD-PARTY-LICENSES")
#: The oldest glibc that the wheels run with.
GLIBC = (2, 17)
#: What the header of an ELF file calls the machines of the wheels.
MACHINES = {"x86_64": 62, "aarch64": 183}


class PackageError(Exception):
    """A package that is not what it should be."""


@dataclass(frozen=True)
class Environment:
    """A virtual environment with nothing in it but what the package requires."""

    folder: Path

    def run(self, *command: str | Path) -> None:
        """Run a command of the environment, in its folder, without the repository, Rust and Node."""
        outside = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
        outside["PATH"] = str(self.folder / "bin")
        program = self.folder / "bin" / str(command[0])
        subprocess.run((program, *command[1:]), cwd=self.folder, env=outside, check=True)

    def install(self, wheel: Path) -> None:
        """Install a wheel in place of the one before, and what it asks for, as it is locked."""
        # Without the hashes: with them pip would take only what is named beside the wheel.
        versions = re.findall(r"^\w.*?(?= \\)", LOCK.read_text("utf-8"), re.MULTILINE)
        locked = self.folder / "locked.txt"
        locked.write_text("\n".join(versions), "utf-8")
        pip = ("python", "-m", "pip", "--disable-pip-version-check")
        self.run(*pip, "install", "--quiet", "--force-reinstall", "--constraint", locked, wheel)
        self.run(*pip, "check")


def say(line: str) -> None:
    """Tell what comes next; some of it takes minutes."""
    print(f"\n== {line}", flush=True)


def maturin(*arguments: str | Path) -> None:
    """Run maturin with the tools of the environment before all others."""
    environment = os.environ | {"PATH": f"{BIN}{os.pathsep}{os.environ['PATH']}"}
    subprocess.run((BIN / "maturin", *arguments), cwd=ROOT, env=environment, check=True)


def only(folder: Path, pattern: str) -> Path:
    """The one file of a folder whose name is like the pattern."""
    found = sorted(folder.glob(pattern))
    if len(found) != 1:
        raise PackageError(f"found {[path.name for path in found]}; expected one {pattern}")
    return found[0]


def build_wheels(folder: Path) -> list[Path]:
    """A wheel for each kind of Linux machine; elsewhere one for this machine."""
    release = ("build", "--release", "--locked", "--out", folder)
    if sys.platform != "linux":
        say(f"wheel for {sys.platform}: compiled with optimisation at link time, which takes minutes")
        maturin(*release)
        return [only(folder, "*.whl")]
    portable = f"manylinux_{GLIBC[0]}_{GLIBC[1]}"
    wheels = []
    for machine in MACHINES:
        say(f"wheel for {machine}: compiled with optimisation at link time, which takes minutes")
        target = f"{machine}-unknown-linux-gnu"
        maturin(*release, "--zig", "--compatibility", portable, "--target", target)
        wheels.append(only(folder, f"*{machine}.whl"))
        check_wheel(wheels[-1])
        check_portable(wheels[-1], machine)
    return wheels


def check_wheel(wheel: Path) -> None:
    """The wheel is for every Python that it says it is for, and holds the licences and the viewer's page."""
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
    print(
        f"{wheel.name}: {wheel.stat().st_size / 1e6:.1f} MB, {len(names)} files, with {', '.join(LICENCES)}"
    )


def check_portable(wheel: Path, machine: str) -> None:
    """The wheel states the glibc and machine that its extension module was linked for."""
    with zipfile.ZipFile(wheel) as archive:
        (module,) = [name for name in archive.namelist() if name.endswith(".so")]
        binary = archive.read(module)
        (statement,) = [name for name in archive.namelist() if name.endswith(".dist-info/WHEEL")]
        tags = BytesParser().parsebytes(archive.read(statement)).get_all("Tag") or []
    wanted = f"manylinux_{GLIBC[0]}_{GLIBC[1]}_{machine}"
    if f"cp311-abi3-{wanted}" not in tags or wanted not in wheel.name:
        raise PackageError(f"{wheel.name}: found the tags {tags}; expected {wanted}")
    if binary[:4] != b"\x7fELF" or int.from_bytes(binary[18:20], "little") != MACHINES[machine]:
        raise PackageError(f"{wheel.name}: {module} is not compiled for {machine}")
    versions = {tuple(map(int, found.split(b"."))) for found in re.findall(rb"\bGLIBC_([\d.]+)\b", binary)}
    if not versions or max(versions) > GLIBC:
        raise PackageError(f"{wheel.name}: {module} needs glibc {max(versions, default=None)}")
    newest = ".".join(map(str, max(versions)))
    print(f"{module}: {len(binary) / 1e6:.1f} MB, {machine}, symbols of glibc {newest} at the newest")


def build_from_sources(sources: Path, folder: Path) -> Path:
    """A wheel for this machine from the packed sources, by pip, outside the repository."""
    environment = os.environ | {
        "PATH": f"{BIN}{os.pathsep}{os.environ['PATH']}",
        "CARGO_TARGET_DIR": str(ROOT / "target"),
    }
    # The tools are those of the environment, so that they are the locked ones.
    pip = (BIN / "python", "-m", "pip", "--disable-pip-version-check", "wheel", "--quiet")
    options = ("--no-deps", "--no-build-isolation", "--wheel-dir", folder, sources)
    subprocess.run((*pip, *options), cwd=folder, env=environment, check=True)
    return only(folder, "*.whl")


def try_out(wheels: Sequence[Path], folder: Path) -> None:
    """Install each of the wheels in an environment that was empty, and render."""
    PICTURES.mkdir(parents=True, exist_ok=True)
    subprocess.run((sys.executable, "-m", "venv", folder), check=True)
    environment = Environment(folder)
    for number, wheel in enumerate(wheels):
        say(f"trial of {wheel.name}: installed in {'an empty' if number == 0 else 'the same'} environment")
        environment.install(wheel)
        environment.run("lumencut")
        environment.run("lumencut", "doctor")
        picture = PICTURES / f"{wheel.stem}.png"
        environment.run("python", "-I", ROOT / "scripts/render_phantom.py", picture)


def package(folder: Path) -> None:
    """Build and check everything in a folder, then put it into dist/."""
    packed, built = folder / "packed", folder / "built"
    built.mkdir()
    say("sources: packed")
    maturin("sdist", "--out", packed)
    sources = only(packed, "*.tar.gz")
    wheels = build_wheels(packed)
    say("sources: a wheel is built from them, compiled as the others were")
    from_sources = build_from_sources(sources, built)
    check_wheel(from_sources)
    native = [wheel for wheel in wheels if sys.platform != "linux" or platform.machine() in wheel.name]
    try_out([*native, from_sources], folder / "environment")
    DIST.mkdir(exist_ok=True)
    for old in DIST.glob("lumencut-*"):
        old.unlink()
    say("dist:")
    for file in (sources, *wheels):
        shutil.move(file, DIST / file.name)
        print(f"{(DIST / file.name).stat().st_size:>10,}  {file.name}")


def main() -> None:
    """Make the packages, or say what is wrong with them."""
    try:
        with tempfile.TemporaryDirectory() as folder:
            package(Path(folder).resolve())
    except (PackageError, OSError, subprocess.CalledProcessError) as error:
        sys.exit(f"packages: {error}")


if __name__ == "__main__":
    main()
