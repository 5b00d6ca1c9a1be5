"""The contact sheet of a cohort: the content of its tiles, and that no other script can run in it."""

from __future__ import annotations

import base64
import hashlib
import json
import re

import pytest

import lumencut
from cohort_page import write_page
from cohort_scenes import run, write_cohort


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    return write_page(tmp_path_factory.mktemp("page"), 250).read_text("utf-8")


def tiles(page):
    return re.findall(r"<li .*?</li>", page, re.DOTALL)


def test_its_policy_lets_its_own_script_and_style_run_and_nothing_else(page):
    policy = re.search(r'Content-Security-Policy" content="([^"]*)"', page)[1]
    assert "default-src 'none'" in policy
    for tag in ("script", "style"):
        (content,) = re.findall(rf"<{tag}>(.*?)</{tag}>", page, re.DOTALL)
        digest = base64.b64encode(hashlib.sha256(content.encode()).digest()).decode()
        assert f"{tag}-src 'sha256-{digest}'" in policy
    assert "http" not in re.sub(r"http-equiv", "", page)
    assert not re.search(r"\son\w+=|\sstyle=", page)


def test_a_tile_tells_how_a_study_ended_and_what_to_look_at(page):
    found = tiles(page)
    assert len(found) == 250
    assert 'data-state="failed"' in found[10]
    assert "crashed: SIGABRT &lt;b&gt;bold&lt;/b&gt;" in found[10]
    assert "12 vessels, 346 mm" in found[35]
    assert "3 flags, 2 doubtful vessels" in found[35]
    assert re.search(r"narrowest 5\.75 mm, vessel 4", found[35])
    assert 'href="sub-p35/sub-p35_view-anterior_desc-focus.png"' in found[35]
    assert 'src="data:image/webp;base64,' in found[35]


def test_more_than_two_hundred_tiles_wait_for_the_script(page):
    is_hidden = ['class="hidden"' in tile for tile in tiles(page)]
    assert is_hidden == [False] * 200 + [True] * 50


@pytest.mark.usefixtures("nursery")
def test_a_batch_writes_it_with_pictures(tmp_path):
    manifest = write_cohort(tmp_path, good=1, bad=False)
    recipe = '[pictures]\nviews = ["left"]\nsize = [220, 200]\nreformations = ["straightened"]\n'
    (tmp_path / "recipe.toml").write_text(f"{recipe}[outputs]\nreport = true\n", "utf-8")
    out = tmp_path / "out"
    ended = run(manifest, out)
    assert ended.returncode == 0, ended.stderr
    (tile,) = tiles((out / "index.html").read_text("utf-8"))
    assert 'href="sub-good0/sub-good0_view-left_desc-focus.png"' in tile
    names = {path.name.removeprefix("sub-good0_") for path in (out / "sub-good0").iterdir()}
    assert names == {
        "view-left_desc-focus.png",
        "desc-straightened.png",
        "thumbnail.webp",
        "desc-centerlines.vtp",
        "vessels.csv",
        "sections.csv",
        "report.html",
        "record.json",
    }
    told = json.loads((out / "dataset_description.json").read_text("utf-8"))
    assert told["DatasetType"] == "derivative"
    assert told["GeneratedBy"] == [{"Name": "Lumencut", "Version": lumencut.__version__}]
