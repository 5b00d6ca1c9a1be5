"""The page of source files is current, and a file that does not say what it holds is refused."""

import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "scripts"))
import source_files  # noqa: E402


def test_the_page_of_source_files_is_current():
    assert source_files.PAGE.read_text("utf-8") == source_files.page(), source_files.MEND


def test_every_part_of_the_product_is_on_the_page():
    page = source_files.PAGE.read_text("utf-8")
    crates = [path.parent.parent.name for path in ROOT.glob("crates/*/src/lib.rs")]
    assert len(crates) > 8
    assert [name for name in crates if f"## crates/{name}/src\n" not in page] == []
    assert "| `depth.rs` `depth.wgsl` | " in page
    assert "| `test_source_files.py` |" not in page


@pytest.mark.parametrize(
    ("name", "text", "sentence"),
    [
        (
            "a.rs",
            "// Of the build.\n//! By Wang et al. 2008. More.\n\nuse b;\n",
            "By Wang et al. 2008.",
        ),
        ("a.rs", "//! Half\n//! a line (of it. All) there. More.\n", "Half a line (of it. All) there."),
        ("a.wgsl", "// The view.\n// import math/view\n// import math/ray\n", "The view."),
        ("a.py", '#!/usr/bin/env python3\n"""Says `it. Now` well.\n\nMore.\n"""\n', "Says `it. Now` well."),
        ("a.ts", "/**\n * What is\n * told. More.\n */\nconst a = 1;\n", "What is told."),
        ("a.mjs", "// Builds it.\n\n// Not this.\n", "Builds it."),
        ("a.rs", "use b;\n//! Too late.\n", ""),
    ],
)
def test_the_first_sentence_of_a_file(tmp_path: Path, name: str, text: str, sentence: str):
    (tmp_path / name).write_text(text, "utf-8")
    assert source_files.first_sentence(tmp_path / name) == sentence


def test_a_file_that_says_nothing_is_refused(monkeypatch: pytest.MonkeyPatch, tmp_path: Path):
    monkeypatch.setattr(source_files, "ROOT", tmp_path)
    (tmp_path / "silent.py").write_text("a = 1\n", "utf-8")
    with pytest.raises(source_files.SourceError, match=r"at the top of silent\.py; expected a sentence"):
        source_files.rows(tmp_path)
