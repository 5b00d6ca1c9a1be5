"""Reports missing tools: Rust and its targets, Node, and what the tests take from Debian.

No tool checks all of them: rust-toolchain.toml may name no targets, since the Rust of a distribution has no
rustup, and apt-get needs root. Needs only Python itself, since it runs before the environment exists.
"""

from __future__ import annotations

import argparse
import ctypes.util
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
#: The target of the viewer's WebAssembly.
WASM = "wasm32-unknown-unknown"
#: Further targets for which everything except the extension module must compile.
TARGETS = (WASM, "aarch64-unknown-linux-gnu", "x86_64-pc-windows-gnu", "aarch64-apple-darwin")

#: Commands of the tests and their Debian packages: the browser, checkers of DICOM files and a PACS.
COMMANDS = {
    "chromium": "chromium",
    "dciodvfy": "dicom3tools",
    "dcm2pnm": "dcmtk",
    "Orthanc": "orthanc",
    "pdftotext": "poppler-utils",
}
#: Orthanc's plugin for DICOMweb, a library.
DICOMWEB_PLUGIN = Path("/usr/share/orthanc/plugins/libOrthancDicomWeb.so")
#: Where drivers of Vulkan are registered.
DRIVERS = (Path("/usr/share/vulkan/icd.d"), Path("/etc/vulkan/icd.d"))


def refuse(found: str, expected: str, mend: str) -> None:
    """Stop with one line: the problem and the remedy."""
    sys.exit(f"toolchain: found {found}; expected {expected}; {mend}")


def said(*command: str) -> str:
    """What a command prints, or why it prints nothing."""
    if shutil.which(command[0]) is None:
        return f"no {command[0]} on the PATH"
    done = subprocess.run(command, check=False, capture_output=True, text=True, cwd=ROOT)
    return done.stdout.strip() or done.stderr.partition("\n")[0]


def oldest_node() -> int:
    """The oldest Node that builds the viewer's page."""
    return int((ROOT / ".nvmrc").read_text("utf-8"))


def check_rust() -> None:
    """Require a new enough Rust with a linker."""
    stated = (ROOT / "Cargo.toml").read_text("utf-8")
    [wanted] = re.findall(r'^rust-version = "([\d.]+)"', stated, re.MULTILINE)
    for tool in ("cargo", "rustc"):
        version = re.match(rf"{tool} (\d+)\.(\d+)", said(tool, "--version"))
        if version is None:
            install = "install it from https://rustup.rs, or name an installed one in RUSTUP_TOOLCHAIN"
            refuse(said(tool, "--version"), f"Rust {wanted} or newer", install)
        elif [int(part) for part in version.groups()] < [int(part) for part in wanted.split(".")[:2]]:
            refuse(version[0], f"Rust {wanted} or newer", "rustup update stable")
    if shutil.which("cc") is None:
        refuse("no C compiler to link with", "cc on the PATH", "apt-get install build-essential")


def libraries() -> Path:
    """Where Rust's libraries are."""
    return Path(said("rustc", "--print", "sysroot")) / "lib/rustlib"


def rustup(*words: str) -> None:
    """Have rustup add something, if there is a rustup."""
    if shutil.which("rustup"):
        print("rustup", *words, flush=True)
        subprocess.run(("rustup", *words), check=False, cwd=ROOT)


def add_targets() -> None:
    """Require Rust's libraries for `TARGETS`; rustup adds missing ones."""

    def missing() -> list[str]:
        return [target for target in TARGETS if not (libraries() / target / "lib").is_dir()]

    if missing():
        rustup("target", "add", *missing())
    if names := " ".join(missing()):
        refuse(f"no {names} in {libraries()}", "Rust's libraries for it", f"rustup target add {names}")


def missing_of_node() -> str:
    """What Node lacks for building the page, or nothing."""
    oldest, version = oldest_node(), said("node", "--version")
    if shutil.which("node") is None or shutil.which("npm") is None:
        return f"no node or no npm on the PATH (Node {oldest} or newer is needed)"
    number = re.match(r"v(\d+)\.", version)
    if number is None or int(number[1]) < oldest:
        return f"Node that says {version!r} ({oldest} or newer is needed)"
    return ""


def missing_of_wasm() -> str:
    """What Rust lacks for WebAssembly, or nothing."""
    if shutil.which("rustc") is None:
        return "no rustc on the PATH"
    if not (libraries() / WASM / "lib").is_dir():
        return f"no {WASM} for Rust (rustup target add {WASM})"
    # Threads in browsers need a standard library compiled from source.
    has_source = (libraries() / "src/rust/library/std/Cargo.toml").is_file()
    return "" if has_source else "no source of Rust's standard library (rustup component add rust-src)"


def add_wasm() -> None:
    """Have rustup install what Rust lacks for WebAssembly."""
    if missing_of_wasm():
        rustup("target", "add", WASM)
        rustup("component", "add", "rust-src")


def add_page() -> None:
    """Require Node and Rust's WebAssembly."""
    add_wasm()
    if missing := missing_of_node() or missing_of_wasm():
        refuse(missing, "what builds the viewer's page", "install it, as CONTRIBUTING.md lists")


def missing_packages() -> list[str]:
    """The Debian packages that the tests need and that are missing."""
    # Debian installs servers in sbin, which may be missing from the users' PATH.
    path = f"{os.environ.get('PATH', '')}{os.pathsep}/usr/sbin"
    missing = [package for command, package in COMMANDS.items() if shutil.which(command, path=path) is None]
    if not DICOMWEB_PLUGIN.exists():
        missing.append("orthanc-dicomweb")
    if ctypes.util.find_library("vulkan") is None:
        missing.append("libvulkan1")
    registered = os.environ.get("VK_DRIVER_FILES") or os.environ.get("VK_ICD_FILENAMES")
    if not registered and not any(path for folder in DRIVERS for path in folder.glob("*.json")):
        missing.append("mesa-vulkan-drivers")
    return missing


def add_debian() -> None:
    """Require Vulkan, the browser, the DICOM checkers and the PACS of the tests; root installs them."""
    missing = missing_packages() if sys.platform == "linux" else []
    if not missing:
        return
    install = ["apt-get", "install", "--yes", "--no-install-recommends", *missing]
    if shutil.which("apt-get") is None or os.geteuid() != 0:
        by_hand = f"as root: {' '.join(install)} (or the same of another distribution)"
        refuse(f"no {', '.join(missing)}", "what the tests need", by_hand)
    print(f"The tests need these packages of Debian, which are installed now: {', '.join(missing)}")
    # At run level 1 Debian starts no services.
    quiet = os.environ | {"DEBIAN_FRONTEND": "noninteractive", "RUNLEVEL": "1"}
    # The package list may be missing or outdated.
    for command in (install, ["apt-get", "update"], install):
        print(" ".join(command), flush=True)
        status = subprocess.run(command, check=False, env=quiet, stdin=subprocess.DEVNULL).returncode
        if status == 0 and command is install:
            break
    if still := missing_packages():
        refuse(f"no {', '.join(still)} after apt-get", "what the tests need", "check the network connection")


def main() -> None:
    """Check the named tools."""
    checks = {"rust": check_rust, "targets": add_targets, "page": add_page, "debian": add_debian}
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("what", choices=checks, nargs="+")
    for what in parser.parse_args().what:
        checks[what]()


if __name__ == "__main__":
    main()
