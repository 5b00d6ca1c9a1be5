"""The pages of results are current, and incomplete files of results are rejected."""

import json
import shutil

import pytest

from script_modules import BENCHES, script


@pytest.fixture(scope="module")
def results():
    yield from script("result_pages", BENCHES)


def broken(results, tmp_path, **changes):
    """Return a copy of the files of results with one changed; a field set to None is removed."""
    data = tmp_path / "results"
    shutil.copytree(results.DATA, data)
    path = data / "memory.json"
    found = {**json.loads(path.read_text("utf-8")), **changes}
    path.write_text(json.dumps({k: v for k, v in found.items() if v is not None}), "utf-8")
    return data


@pytest.mark.parametrize("name", ["speed", "accuracy"])
def test_a_page_is_current(name, results):
    assert (results.PAGES / f"{name}.md").read_text("utf-8") == results.pages()[name]


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"machine": "my laptop"}, "memory.json: found the machine 'my laptop'; expected one of pages.json"),
        ({"date": "yesterday"}, "memory.json: found the date 'yesterday'; expected YYYY-MM-DD"),
        ({"title": "Disk"}, "memory.json: found the title 'Disk'; expected the file's name"),
        ({"bound": None}, "memory.json: found no 'bound'; expected one"),
        ({"rows": [["one cell"]]}, r"memory.json: found \['one cell'\] as row 1; expected 3 cells"),
        ({"remark": "fast"}, r"memory.json: found \['remark'\]; expected only known fields"),
    ],
)
def test_a_broken_subject_is_rejected(changes, message, results, tmp_path):
    with pytest.raises(results.ResultError, match=message):
        results.pages(broken(results, tmp_path, **changes))


def test_text_that_is_no_json_is_rejected(results, tmp_path):
    data = broken(results, tmp_path)
    (data / "memory.json").write_text("{", "utf-8")
    with pytest.raises(results.ResultError, match=r"memory.json: found no readable JSON"):
        results.pages(data)


def test_a_file_that_no_page_lists_is_rejected(results, tmp_path):
    data = broken(results, tmp_path)
    shutil.copy(data / "memory.json", data / "more.json")
    with pytest.raises(
        results.ResultError, match=r"found \['more'\]; expected only subjects that a page lists"
    ):
        results.pages(data)
