"""Build the viewer's page into the package, or write it as a separate site.

The page is built from `web/` by Node 20 or newer, and its WebAssembly by Rust:

    npm ci --prefix web && npm run build --prefix web

It builds only if a source is newer than the page. With --if-possible a missing tool is reported but is no
error; with --site FOLDER the page is copied for a static file server. Needs only Python and these tools: npm
knows neither Rust's sources nor what the package needs when Node is missing.
"""

from __future__ import annotations

import argparse
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from itertools import chain
from pathlib import Path

import notices
from licences import LicenceError
from toolchain import add_wasm, missing_of_node, missing_of_wasm

ROOT = Path(__file__).resolve().parent.parent
WEB = ROOT / "web"
PAGE = ROOT / "python/lumencut/viewer/page"
#: Written by the build or installed for it; not sources.
_NO_SOURCES = {"node_modules", "dist", "test-results", "playwright-report", ".vite"}
#: Addresses that leave the folder of the page.
_ABSOLUTE = re.compile(r"""(?:src|href)\s*=\s*["']?(?:/|[a-z]+:)""", re.IGNORECASE)
_LICENCES = ("LICENSE-MIT", "LICENSE-APACHE")


class PageError(Exception):
    """A page that cannot be built or is invalid."""


def sources() -> Iterator[Path]:
    """The sources of the page."""
    of_crates = (ROOT.glob(f"crates/*/{pattern}") for pattern in ("src/**/*", "Cargo.toml", "build.rs"))
    for path in (*WEB.rglob("*"), *chain.from_iterable(of_crates)):
        inner = path.relative_to(ROOT).parts[1:]
        if path.is_file() and not _NO_SOURCES.intersection(inner) and path != notices.NOTICES:
            yield path
    yield from (ROOT / "Cargo.lock", ROOT / "Cargo.toml")


def is_current() -> bool:
    """Whether the page is newer than all its sources."""
    index = PAGE / "index.html"
    return index.is_file() and all(path.stat().st_mtime <= index.stat().st_mtime for path in sources())


def missing() -> str:
    """What the build lacks on this machine, or nothing."""
    if not (WEB / "package-lock.json").is_file():
        return f"no sources of the page in {WEB}"
    return missing_of_node() or missing_of_wasm()


def build() -> None:
    """Build the page and replace the previous one."""
    npm("ci", "--no-audit", "--no-fund")
    notices.write()
    npm("run", "build")
    install(WEB / "dist", PAGE)


def npm(*words: str) -> None:
    """Run npm in `web`."""
    # On Windows npm cannot be started by its bare name.
    program = shutil.which("npm") or "npm"
    subprocess.run((program, *words, "--prefix", str(WEB)), cwd=ROOT, check=True, stdin=subprocess.DEVNULL)


def install(built: Path, place: Path) -> None:
    """Copy a page whole, so that its files are as new as the copy."""
    if not (built / "index.html").is_file():
        raise PageError(f"found no index.html in {built}; expected the built page")
    new = place.with_name(f"{place.name}.new")
    shutil.rmtree(new, ignore_errors=True)
    shutil.copytree(built, new, copy_function=shutil.copy)
    shutil.rmtree(place, ignore_errors=True)
    new.rename(place)


def write_site(folder: Path) -> None:
    """Copy the page with the licences, for a static file server."""
    found = _ABSOLUTE.search((PAGE / "index.html").read_text("utf-8"))
    if found:
        raise PageError(f"index.html: found {found[0]!r}; expected addresses relative to the page alone")
    install(PAGE, folder)
    for name in _LICENCES:
        shutil.copy(ROOT / name, folder / name)
    print(f"{folder}: {sum(path.is_file() for path in folder.rglob('*'))} files")


def build_if_possible() -> bool:
    """Build the page if it is out of date and the tools exist; return whether there is one."""
    if is_current():
        return True
    lacking = missing()
    if not lacking:
        try:
            build()
        except (PageError, LicenceError, OSError, subprocess.CalledProcessError) as error:
            lacking = str(error)
    if lacking:
        kept = "the one of before is kept" if (PAGE / "index.html").is_file() else "`lumencut view` needs it"
        print(f"page: {lacking}; the viewer's page is not built; {kept}", file=sys.stderr)
    return not lacking


def main() -> None:
    """Build the page, or report why not."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--if-possible", action="store_true", help="a missing tool is no error")
    parser.add_argument("--site", type=Path, metavar="FOLDER", help="write the page as a site, too")
    asked = parser.parse_args()
    if (WEB / "package-lock.json").is_file() and not is_current():
        add_wasm()
    try:
        if asked.if_possible:
            build_if_possible()
        elif not is_current():
            if lacking := missing():
                raise PageError(lacking)
            build()
        if asked.site:
            write_site(asked.site.resolve())
    except (PageError, LicenceError, OSError, subprocess.CalledProcessError) as error:
        sys.exit(f"page: {error}")


if __name__ == "__main__":
    main()
