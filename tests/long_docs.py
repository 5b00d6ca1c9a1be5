"""Builds the documentation site and opens it in a browser; needs the demo's CT and Node."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from site_checks import check_site

ROOT = Path(__file__).resolve().parents[1]


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """The built site."""
    target = tmp_path_factory.mktemp("docs") / "site"
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet", "--site-dir", target]
    environment = os.environ | {"NO_MKDOCS_2_WARNING": "true"}
    done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return target


def test_the_site_holds_its_pages_and_pictures(site):
    pages = {path.relative_to(site).as_posix() for path in site.rglob("*.html")}
    assert {"index.html", "gallery.html", "method/cut-surface.html", "api/measuring.html"} <= pages
    made = {path.stem for path in (site / "gallery").glob("*.webp")}
    assert made == {path.stem for path in (ROOT / "examples/gallery").glob("*.py")}
    told = (site / "api/pictures.html").read_text("utf-8")
    assert 'id="lumencut.Camera.rotated"' in told


def test_the_site_needs_no_other_host_and_no_link_is_broken(site):
    check_site(site)


def test_the_site_in_a_browser(site):
    browser = [ROOT / "web/node_modules/.bin/playwright", "test", "--project=cpu", "e2e/docs.spec.ts"]
    environment = os.environ | {"LUMENCUT_DOCS_SITE": str(site)}
    done = subprocess.run(
        browser, cwd=ROOT / "web", env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "5 passed" in done.stdout
