"""Reports missing tools: Python, Rust and its targets, Vulkan, Node, Chromium, DICOM checkers.

Needs only Python itself, since it runs before the environment exists.
"""

from __future__ import annotations

import argparse
import ctypes.util
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
#: The target of the viewer's WebAssembly.
WASM = "wasm32-unknown-unknown"
#: The oldest Node that builds the viewer's page.
NODE = 20
#: Further targets for which everything except the extension module must compile.
TARGETS = (
    WASM,
    "aarch64-unknown-linux-gnu",
    "x86_64-pc-windows-gnu",
    "aarch64-apple-darwin",
)

#: Vulkan's loader and a software driver, for GPU tests without a GPU.
VULKAN_PACKAGES = ("libvulkan1", "mesa-vulkan-drivers")
#: Checkers of written DICOM files: command and Debian package.
DICOM_TOOLS = {
    "dciodvfy": "dicom3tools",
    "dcm2pnm": "dcmtk",
    "Orthanc": "orthanc",
    "pdftotext": "poppler-utils",
}
#: Orthanc's DICOMweb plugin (a library) and its package.
DICOMWEB_PLUGIN, DICOMWEB_PACKAGE = "libOrthancDicomWeb.so", "orthanc-dicomweb"
#: Where Debian installs the plugins of Orthanc.
ORTHANC_PLUGINS = Path("/usr/share/orthanc/plugins")
#: Where Vulkan drivers are registered.
DRIVERS = (Path("/usr/share/vulkan/icd.d"), Path("/etc/vulkan/icd.d"))


def refuse(found: str, expected: str, mend: str) -> None:
    """Stop with one line: the problem and the remedy."""
    sys.exit(f"toolchain: found {found}; expected {expected}; {mend}")


def check_python() -> None:
    """Require a Python that is new enough and has venv."""
    if sys.version_info < (3, 11):  # noqa: UP036
        refuse(
            f"Python {sys.version.split()[0]} at {sys.executable}",
            "Python 3.11 or newer",
            "install one and name it: make PYTHON=python3.11 ...",
        )
    try:
        import ensurepip  # noqa: F401
        import venv  # noqa: F401
    except ImportError as error:
        refuse(
            f"Python without {error.name}", "the modules venv and ensurepip", "apt-get install python3-venv"
        )


def wanted_rust() -> str:
    """`rust-version` of Cargo.toml."""
    found = re.search(r'^rust-version = "([\d.]+)"', (ROOT / "Cargo.toml").read_text("utf-8"), re.MULTILINE)
    if found is None:
        raise ValueError("Cargo.toml states no rust-version")
    return found[1]


def check_rust() -> None:
    """Require a new enough Rust with a linker."""
    wanted = wanted_rust()
    install = "install it with rustup (https://rustup.rs)"
    for tool in ("cargo", "rustc"):
        if shutil.which(tool) is None:
            refuse(f"no {tool} on the PATH", f"Rust {wanted} or newer", install)
    said = subprocess.run(["rustc", "--version"], check=False, capture_output=True, text=True, cwd=ROOT)
    version = re.match(r"rustc (\d+)\.(\d+)", said.stdout)
    if version is None:
        refuse(f"rustc that says {said.stderr.strip()!r}", f"Rust {wanted} or newer", install)
    elif [int(part) for part in version.groups()] < [int(part) for part in wanted.split(".")[:2]]:
        refuse(said.stdout.strip(), f"Rust {wanted} or newer", "rustup update stable")
    if shutil.which("cc") is None:
        refuse("no C compiler to link with", "cc on the PATH", "apt-get install build-essential")


def add_targets() -> None:
    """Require Rust's libraries for `TARGETS`; rustup adds missing ones."""
    sysroot = subprocess.run(
        ["rustc", "--print", "sysroot"], check=True, capture_output=True, text=True, cwd=ROOT
    )
    libraries = Path(sysroot.stdout.strip()) / "lib" / "rustlib"
    missing = [target for target in TARGETS if not (libraries / target / "lib").is_dir()]
    if not missing:
        return
    names = " ".join(missing)
    if shutil.which("rustup") is None:
        refuse(
            f"no {names} in {libraries}",
            "rustup, which adds it",
            "install Rust with rustup (https://rustup.rs)",
        )
    print(f"rustup target add {names}", flush=True)
    if subprocess.run(["rustup", "target", "add", *missing], check=False, cwd=ROOT).returncode:
        refuse(f"rustup unable to add {names}", "Rust's libraries for it", "check the network connection")


def missing_of_node() -> str:
    """What Node lacks for building the page, or nothing."""
    node = shutil.which("node")
    if node is None or shutil.which("npm") is None:
        return f"no node or no npm on the PATH (Node {NODE} or newer is needed)"
    said = subprocess.run([node, "--version"], check=False, capture_output=True, text=True).stdout.strip()
    version = re.match(r"v(\d+)\.", said)
    if version is None or int(version[1]) < NODE:
        return f"Node that says {said!r} ({NODE} or newer is needed)"
    return ""


def missing_of_wasm() -> str:
    """What Rust lacks for WebAssembly, or nothing."""
    if shutil.which("rustc") is None:
        return "no rustc on the PATH"
    command = ["rustc", "--print", "sysroot"]
    said = subprocess.run(command, check=False, capture_output=True, text=True, cwd=ROOT).stdout.strip()
    libraries = Path(said) / "lib/rustlib"
    if not (libraries / WASM / "lib").is_dir():
        return f"no {WASM} for Rust (rustup target add {WASM})"
    # Threads in browsers need a standard library compiled from source.
    has_source = (libraries / "src/rust/library/std/Cargo.toml").is_file()
    return "" if has_source else "no source of Rust's standard library (rustup component add rust-src)"


def add_page() -> None:
    """Require Node and Rust's WebAssembly; rustup adds what it can."""
    if missing := missing_of_node():
        refuse(missing, f"Node {NODE} or newer", "install it, as from nodejs.org or your distribution")
    add_wasm()
    if missing := missing_of_wasm():
        refuse(missing, "what compiles the viewer's module", "check the network connection")


def add_wasm() -> None:
    """Have rustup install what Rust lacks for WebAssembly."""
    if missing_of_wasm() and shutil.which("rustup"):
        subprocess.run(["rustup", "target", "add", WASM], check=False, cwd=ROOT)
        subprocess.run(["rustup", "component", "add", "rust-src"], check=False, cwd=ROOT)


def apt_command(packages: Sequence[str]) -> list[str]:
    """Debian's package manager."""
    return ["apt-get", "install", "--yes", "--no-install-recommends", *packages]


def is_apt_allowed() -> bool:
    """Whether this process may install packages of Debian."""
    return shutil.which("apt-get") is not None and os.geteuid() == 0


def apt_install(packages: Sequence[str]) -> None:
    """Install Debian packages if possible; their servers are not started."""
    install = apt_command(packages)
    # At run level 1 Debian starts no services.
    quiet = os.environ | {"DEBIAN_FRONTEND": "noninteractive", "RUNLEVEL": "1"}
    # The package list may be missing or outdated.
    for command in (install, ["apt-get", "update"], install):
        print(" ".join(command), flush=True)
        done = subprocess.run(command, check=False, env=quiet, stdin=subprocess.DEVNULL).returncode == 0
        if done and command is install:
            break


def add_browser() -> None:
    """Require Chromium for the tests of the page; on Debian, root installs it."""
    if shutil.which("chromium"):
        return
    packages = ("chromium",)
    if not is_apt_allowed():
        by_hand = f"as root: {' '.join(apt_command(packages))}"
        refuse("no chromium on the PATH", "the browser of the tests", by_hand)
    apt_install(packages)
    if shutil.which("chromium") is None:
        refuse("no chromium after apt-get", "the browser of the tests", "check the network connection")


def missing_of_dicom() -> list[str]:
    """The missing Debian packages that check DICOM files."""
    # Debian installs servers in sbin, which may be missing from the users' PATH.
    path = f"{os.environ.get('PATH', '')}{os.pathsep}/usr/sbin"
    packages = [package for tool, package in DICOM_TOOLS.items() if shutil.which(tool, path=path) is None]
    return packages + ([] if (ORTHANC_PLUGINS / DICOMWEB_PLUGIN).exists() else [DICOMWEB_PACKAGE])


def add_dicom() -> None:
    """Require the DICOM checkers and the PACS of the tests; on Debian, root installs them."""
    missing = missing_of_dicom()
    if not missing:
        return
    by_hand = f"as root: {' '.join(apt_command(missing))} (or the same of another distribution)"
    if not is_apt_allowed():
        refuse(f"no {', '.join(missing)}", "what judges DICOM files in the tests", by_hand)
    apt_install(missing)
    if still := missing_of_dicom():
        refuse(
            f"no {', '.join(still)} after apt-get", "what judges DICOM files", "check the network connection"
        )


def missing_of_vulkan() -> str:
    """What Vulkan lacks, or nothing."""
    if ctypes.util.find_library("vulkan") is None:
        return "no loader of Vulkan (libvulkan.so.1)"
    registered = os.environ.get("VK_DRIVER_FILES") or os.environ.get("VK_ICD_FILENAMES")
    if not registered and not any(path for folder in DRIVERS for path in folder.glob("*.json")):
        return f"no driver of Vulkan in {' or '.join(map(str, DRIVERS))}"
    return ""


def add_vulkan() -> None:
    """Require Vulkan for the GPU tests; on Debian, root installs it."""
    missing = missing_of_vulkan() if sys.platform == "linux" else ""
    if not missing:
        return
    by_hand = f"as root: {' '.join(apt_command(VULKAN_PACKAGES))} (or the same of another distribution)"
    if not is_apt_allowed():
        refuse(missing, "Vulkan, which the tests of the GPU need", by_hand)
    apt_install(VULKAN_PACKAGES)
    missing = missing_of_vulkan()
    if missing:
        tried = " ".join(apt_command(VULKAN_PACKAGES))
        refuse(f"{missing} after {tried}", "Vulkan", "check the network connection")


def main() -> None:
    """Check the named tools."""
    checks = {
        "python": check_python,
        "rust": check_rust,
        "targets": add_targets,
        "vulkan": add_vulkan,
        "page": add_page,
        "browser": add_browser,
        "dicom": add_dicom,
    }
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("what", choices=checks, nargs="+")
    for what in parser.parse_args().what:
        checks[what]()


if __name__ == "__main__":
    main()
