"""Write the notices of the viewer's page: the licence texts of its npm packages and crates.

Packages are the run-time ones of `web/package-lock.json`, crates those that the WebAssembly links.
`make page` runs it after `npm ci`. Plugins of Vite list packages, but neither crates nor compiled codecs.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from licences import Crate, LicenceError, linked_crates, listing, shipped_texts, standard_text

ROOT = Path(__file__).resolve().parent.parent
WEB = ROOT / "web"
#: The build of the page copies it.
NOTICES = WEB / "public/THIRD-PARTY-NOTICES.txt"
CRATES = ("lumencut-wasm", "lumencut-dicom-wasm", "lumencut-volumes-wasm")
TARGET = "wasm32-unknown-unknown"
#: Packages without a licence text; they get the standard text.
WITHOUT_TEXT: frozenset[str] = frozenset({"@cornerstonejs/codec-openjpeg"})
#: Packages with a compiled library whose licence they do not ship, and its text in `web/licences`.
COMPILED = {
    "@cornerstonejs/codec-charls": ("charls",),
    "@cornerstonejs/codec-libjpeg-turbo-8bit": ("isc", "libjpeg-turbo"),
    "@cornerstonejs/codec-openjpeg": ("openjpeg",),
    "@cornerstonejs/codec-openjph": ("openjph",),
}
HEADING = """\
Licences of third parties

The viewer's page of Lumencut holds the npm packages and the Rust crates below, each under the
licence beside it. The licence texts follow; where a package ships none, it is the standard text.
scripts/notices.py writes this file.
"""


def packages(web: Path) -> list[Crate]:
    """The npm packages that the page needs at run time."""
    locked: dict[str, dict[str, Any]] = json.loads((web / "package-lock.json").read_text("utf-8"))["packages"]
    return [package_of(web / place, package) for place, package in needed(locked)]


def needed(locked: dict[str, dict[str, Any]]) -> Iterator[tuple[str, dict[str, Any]]]:
    """The paths of run-time packages in a lock file; the empty path is the page itself."""
    for place, package in locked.items():
        if place and not (package.get("dev") or package.get("devOptional") or package.get("link")):
            yield place, package


def package_of(folder: Path, package: dict[str, Any]) -> Crate:
    """A package as the lock file describes it, with its texts."""
    name = folder.as_posix().rpartition("node_modules/")[2]
    licence = package.get("license") or "none stated"
    texts = shipped_texts(folder) if folder.is_dir() else []
    if not texts and name not in WITHOUT_TEXT | COMPILED.keys():
        raise LicenceError(
            f"{name} {package.get('version')}: found no licence text; expected one in {folder}; if the "
            "standard "
            f"text of {licence!r} will do, add the package to WITHOUT_TEXT in scripts/notices.py"
        )
    ships_none = not texts
    if name in WITHOUT_TEXT:
        texts = [standard_text(licence, f"the authors of {name}")]
    texts += [(WEB / f"licences/{text}.txt").read_text("utf-8") for text in COMPILED.get(name, ())]
    return Crate(name, str(package.get("version", "")), licence, tuple(texts), is_standard=ships_none)


def crates() -> list[Crate]:
    """The crates that the WebAssembly links."""
    found = {
        (crate.name, crate.version): crate for root in CRATES for crate in linked_crates((TARGET,), root)
    }
    return sorted(found.values(), key=lambda crate: (crate.name, crate.version))


def write() -> None:
    """Write the file, unless nothing changed."""
    text = listing([*packages(WEB), *crates()], HEADING)
    if not NOTICES.is_file() or NOTICES.read_text("utf-8") != text:
        NOTICES.parent.mkdir(parents=True, exist_ok=True)
        NOTICES.write_text(text, "utf-8")
