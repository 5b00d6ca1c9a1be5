"""Write THIRD-PARTY-LICENSES: the licence texts of the crates linked into the extension module.

The texts come from the crates; shared texts appear once. A crate without a text is listed in `WITHOUT_TEXT`
and gets the standard text of its licence. With --check the file must match the locked crates.
Needs only Python itself and cargo; cargo deny collects no texts, and cargo about takes minutes to compile.
"""

from __future__ import annotations

import argparse
import json
import re
import subprocess
import sys
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
LISTING = ROOT / "THIRD-PARTY-LICENSES"
#: The crate of the extension module.
PACKAGE = "lumencut-python"
#: All platforms of the package; the list contains the crates of each platform.
TARGETS = (
    "x86_64-unknown-linux-gnu",
    "aarch64-unknown-linux-gnu",
    "x86_64-pc-windows-gnu",
    "aarch64-apple-darwin",
)
#: Crates of features that only tests switch on.
FOR_TESTS = frozenset({"ts-rs"})

#: Crates without a licence text; they get the standard text.
WITHOUT_TEXT = frozenset(
    {
        "block2",
        "dispatch2",
        "objc2",
        "objc2-core-foundation",
        "objc2-core-graphics",
        "objc2-encode",
        "objc2-foundation",
        "objc2-io-surface",
        "objc2-metal",
        "objc2-quartz-core",
        "profiling",
        "spirv",
    }
)
#: The names of files with licence texts.
NAMES = re.compile(r"(un)?licen[cs]e|copying|copyright|notice", re.IGNORECASE)
HEADING = f"""\
Licences of third parties

The extension module of the Python package lumencut links the Rust crates below, each under
the licence beside it. Which of them are linked depends on the platform; this is what any of
{", ".join(TARGETS[:2])},
{" and ".join(TARGETS[2:])} links.
The licence texts follow; where a crate ships none, it is the standard text.
scripts/licences.py writes this file.
"""


class LicenceError(Exception):
    """A crate without a known licence text."""


@dataclass(frozen=True)
class Crate:
    """A linked crate, its licence as an SPDX expression, and its licence texts."""

    name: str
    version: str
    licence: str
    texts: tuple[str, ...]
    is_standard: bool = False


def standard_text(licence: str, holders: str) -> str:
    """The standard text of the first licence in an SPDX expression with a text in this repository."""
    choices = re.split(r" OR |/", licence)
    if "Apache-2.0" in choices:
        return (ROOT / "LICENSE-APACHE").read_text("utf-8")
    if "MIT" in choices:
        own = (ROOT / "LICENSE-MIT").read_text("utf-8")
        return re.sub(r"^Copyright .*$", lambda _: f"Copyright (c) {holders}", own, flags=re.MULTILINE)
    raise LicenceError(f"found {licence!r}; expected a choice of Apache-2.0 or MIT, whose texts are here")


def shipped_texts(folder: Path) -> list[str]:
    """Return the licence texts in the folder of a crate."""
    files = sorted(path for path in folder.iterdir() if NAMES.match(path.name) and path.is_file())
    return [path.read_text("utf-8") for path in files]


def crate_of(package: dict[str, Any]) -> Crate:
    """A crate as `cargo metadata` describes it, with its texts."""
    name, version, licence = package["name"], package["version"], package["license"] or "none stated"
    texts = shipped_texts(Path(package["manifest_path"]).parent)
    if texts and name in WITHOUT_TEXT:
        raise LicenceError(f"{name} {version} ships a licence text; take it out of WITHOUT_TEXT")
    if not texts and name not in WITHOUT_TEXT:
        raise LicenceError(
            f"{name} {version}: found no licence text; expected one in its folder; if the standard text of "
            f"{licence!r} will do, add the crate to WITHOUT_TEXT in scripts/licences.py"
        )
    holders = ", ".join(package["authors"]) or f"the authors of {name}"
    shown = texts or [standard_text(licence, holders)]
    return Crate(name, version, licence, tuple(shown), is_standard=not texts)


def linked(metadata: dict[str, Any], root: str) -> list[dict[str, Any]]:
    """The foreign packages compiled into `root`, without build and test dependencies."""
    packages = {package["id"]: package for package in metadata["packages"]}
    needs = {node["id"]: node["deps"] for node in metadata["resolve"]["nodes"]}
    wanted = [key for key, package in packages.items() if package["name"] == root]
    found: dict[str, dict[str, Any]] = {}
    while wanted:
        key = wanted.pop()
        is_macro = any("proc-macro" in target["kind"] for target in packages[key]["targets"])
        if key in found or is_macro or packages[key]["name"] in FOR_TESTS:
            continue
        found[key] = packages[key]
        kinds = ((need["pkg"], [kind["kind"] for kind in need["dep_kinds"]]) for need in needs[key])
        wanted += [needed for needed, kind in kinds if None in kind]
    return [package for package in found.values() if package["source"]]


def linked_crates(targets: Sequence[str], root: str = PACKAGE) -> list[Crate]:
    """The crates that `root` links on any of the targets, by name, with the standard library of Rust."""
    found: dict[str, dict[str, Any]] = {}
    for target in targets:
        command = ("cargo", "metadata", "--locked", "--format-version=1", "--filter-platform", target)
        printed = subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.PIPE).stdout
        found |= {package["id"]: package for package in linked(json.loads(printed), root)}
    crates = [crate_of(package) for package in found.values()]
    unused = WITHOUT_TEXT - {crate.name for crate in crates}
    # The WebAssembly module links fewer crates than the extension module, so unused entries are normal.
    if unused and root == PACKAGE:
        raise LicenceError(f"{', '.join(sorted(unused))}: not linked; take it out of WITHOUT_TEXT")
    library = "MIT OR Apache-2.0"
    text = standard_text("MIT", "The Rust Project Contributors")
    crates.append(Crate("std (the standard library of Rust)", "", library, (text,)))
    return sorted(crates, key=lambda crate: (crate.name, crate.version))


def listing(crates: Iterable[Crate], heading: str = HEADING) -> str:
    """The file: the crates, then each text once with its crates."""
    table, texts = [], dict[str, tuple[str, list[str]]]()
    for crate in crates:
        remark = " (ships no licence text)" if crate.is_standard else ""
        table.append(f"{crate.name} {crate.version}".strip() + f": {crate.licence}{remark}")
        for text in crate.texts:
            # Copies of one text may differ in line breaks and indentation.
            _, names = texts.setdefault(" ".join(text.split()), (text, []))
            names += [] if crate.name in names else [crate.name]
    parts = [heading, "\n".join(table) + "\n"]
    for text, names in texts.values():
        lines = [line.rstrip() for line in text.strip("\r\n").splitlines()]
        parts.append(f"{'=' * 80}\n{', '.join(names)}\n{'=' * 80}\n\n" + "\n".join(lines) + "\n")
    return "\n".join(parts)


def main() -> None:
    """Write or compare the file; fail if a crate has no text or the file is stale."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--check", action="store_true", help="write nothing; fail where the file is stale")
    check = parser.parse_args().check
    try:
        crates = linked_crates(TARGETS)
    except (LicenceError, OSError, UnicodeDecodeError, subprocess.CalledProcessError) as error:
        sys.exit(f"licences: {error}")
    wanted = listing(crates)
    if not check:
        LISTING.write_text(wanted, "utf-8")
    elif not LISTING.exists() or LISTING.read_text("utf-8") != wanted:
        sys.exit(f"licences: {LISTING.name} is not what the locked crates make of it; mend it: make generate")
    print(f"{LISTING.name}: {len(crates)} crates")


if __name__ == "__main__":
    main()
