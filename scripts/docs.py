"""Build the documentation site into ./docs-site: offline, searchable, with new pictures.

    .venv/bin/python scripts/docs.py

It collects the pages in target/docs, runs the scripts of the gallery, runs MkDocs and checks the result.
Only a complete site replaces the previous one.
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from docs_api import api_pages
from docs_pages import GALLERY, PICTURES, ROOT, PageError, Script, page_sources, scripts_of, site_page
from docs_site import SiteError, check_site

WORK = ROOT / "target/docs"
PAGES, SITE = WORK / "pages", WORK / "site"
#: Files that the pages of the site load.
OWN_FILES = ("site.css", "iframe-worker.js")
#: Time limit of one picture (s).
_PATIENCE = 300


def write_pages(folder: Path) -> None:
    """Write all pages, and copy the files they link to."""
    for name, source in page_sources().items():
        text, files = site_page(source)
        _write(folder / name, text)
        for target, path in files.items():
            (folder / target).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(path, folder / target)
    for name, text in api_pages().items():
        _write(folder / name, text)
    for path in (*(ROOT / "docs" / name for name in OWN_FILES), ROOT / "web/public/icon.svg"):
        shutil.copyfile(path, folder / path.name)


def _write(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, "utf-8")


def check_stent() -> None:
    """Fail at once if the CT that most pictures show is not available."""
    from lumencut.demo import stent_scene
    from lumencut.errors import LumencutError

    try:
        stent_scene()
    except LumencutError as error:
        raise PageError(f"the CT of the gallery: {error}") from error


def draw(script: Script, folder: Path) -> float:
    """Run a script of the gallery and return the seconds it took."""
    start = time.monotonic()
    paths = [str(ROOT / "python"), os.environ.get("PYTHONPATH", "")]
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(filter(None, paths))}
    try:
        done = subprocess.run(
            [sys.executable, "-W", "error", script.path],
            cwd=folder,
            env=environment,
            capture_output=True,
            text=True,
            timeout=_PATIENCE,
        )
    except subprocess.TimeoutExpired:
        raise PageError(f"{script.path.name}: found no end after {_PATIENCE} s") from None
    if done.returncode:
        raise PageError(f"{script.path.name}: {done.stderr.strip().splitlines()[-1]}")
    assert script.picture is not None
    if not (folder / script.picture).is_file():
        raise PageError(f"{script.path.name}: found no {script.picture} after it ran; expected this picture")
    return time.monotonic() - start


def draw_all(folder: Path) -> None:
    """Make all pictures of the gallery, two at a time."""
    folder.mkdir(parents=True)
    scripts = scripts_of(GALLERY)
    with ThreadPoolExecutor(2) as pool:
        taken = list(pool.map(lambda script: draw(script, folder), scripts))
    for script, seconds in zip(scripts, taken, strict=True):
        print(f"{seconds:8.1f}  {script.path.stem}")


def build() -> None:
    """Make the site in `target/docs`."""
    shutil.rmtree(WORK, ignore_errors=True)
    check_stent()
    write_pages(PAGES)
    draw_all(PAGES / PICTURES)
    # With --strict, warnings of MkDocs end the build.
    environment = os.environ | {"NO_MKDOCS_2_WARNING": "true"}
    mkdocs = [sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet"]
    if subprocess.run(mkdocs, cwd=ROOT, env=environment, check=False).returncode:
        raise PageError("MkDocs: found the warnings above; expected none")
    # It works only at the root of a host.
    (SITE / "404.html").unlink()
    check_site(SITE)


def main() -> int:
    """Build the site and move it to its place."""
    parser = argparse.ArgumentParser(description="Build the documentation site into ./docs-site.")
    parser.add_argument("--output", type=Path, default=ROOT / "docs-site", help="where the site goes")
    target: Path = parser.parse_args().output
    start = time.monotonic()
    try:
        build()
    except (PageError, SiteError) as error:
        print(f"docs: {error}; no site was written", file=sys.stderr)
        return 1
    shutil.rmtree(target, ignore_errors=True)
    shutil.move(SITE, target)
    print(f"{target / 'index.html'}: built in {time.monotonic() - start:.0f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
