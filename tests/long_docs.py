"""Builds the documentation site and opens it in a browser; needs the demo's CT and Node."""

import os
import subprocess
import sys

import pytest

from script_modules import SCRIPTS

ROOT = SCRIPTS.parent


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """The built site."""
    target = tmp_path_factory.mktemp("docs") / "site"
    command = [sys.executable, SCRIPTS / "docs.py", "--output", target]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return target


def test_the_site_holds_its_pages_and_pictures(site):
    pages = {path.relative_to(site).as_posix() for path in site.rglob("*.html")}
    assert {"index.html", "gallery.html", "method/cut-surface.html", "api/measuring.html"} <= pages
    made = {path.stem for path in (site / "gallery").glob("*.webp")}
    assert made == {path.stem for path in (ROOT / "examples/gallery").glob("*.py")}
    told = (site / "api/pictures.html").read_text("utf-8")
    assert 'id="lumencut.scene.camera.Camera.rotated"' in told


def test_the_site_in_a_browser(site):
    browser = [ROOT / "web/node_modules/.bin/playwright", "test", "--project=cpu", "e2e/docs.spec.ts"]
    environment = os.environ | {"LUMENCUT_DOCS_SITE": str(site)}
    done = subprocess.run(
        browser, cwd=ROOT / "web", env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "5 passed" in done.stdout
