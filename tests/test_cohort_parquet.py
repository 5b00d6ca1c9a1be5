"""The tables of a cohort as Parquet: the same values; numbers are numbers, ids are text."""

from __future__ import annotations

import csv
import sys

import pyarrow as pa
import pytest
from pyarrow import parquet

from cohort_scenes import run, table, write_cohort
from lumencut.cohort.parquet import check_parquet, write_parquet
from lumencut.errors import MissingPackageError


@pytest.mark.usefixtures("nursery")
def test_a_batch_writes_its_tables_as_parquet_too(tmp_path):
    manifest = write_cohort(tmp_path, good=2, bad=False)
    text = "id,volume,centerlines,visit_mm\n01,good-0.nii.gz,tube.vtk,007\n02,good-1.nii.gz,,\n"
    manifest.write_text(text, "utf-8")
    out = tmp_path / "out"
    ended = run(manifest, out, "--parquet")
    assert ended.returncode == 0, ended.stderr
    for name in ("studies", "vessels", "sections"):
        rows, found = table(out / f"{name}.csv"), parquet.read_table(out / f"{name}.parquet")
        assert found.column_names == list(rows[0])
        for column in found.column_names:
            written = [row[column] or None for row in rows]
            values = found.column(column).to_pylist()
            if pa.types.is_floating(found.schema.field(column).type):
                assert values == [None if word is None else float(word) for word in written], column
            else:
                assert values == written, column
    studies = parquet.read_table(out / "studies.parquet")
    assert studies.column("id").to_pylist() == ["01", "02"]
    # A further column holds text as in the manifest, whatever its name.
    assert studies.column("visit_mm").to_pylist() == ["007", None]
    sections = parquet.read_table(out / "sections.parquet", columns=["diameter_equivalent_mm", "flags"])
    assert pa.types.is_floating(sections.schema.field("diameter_equivalent_mm").type)
    assert pa.types.is_string(sections.schema.field("flags").type)


def test_words_with_line_breaks_and_empty_tables(tmp_path):
    with (tmp_path / "a.csv").open("w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows([["id", "length_mm"], ["two\nlines", "1.5"], ["b", ""], ["'=1", "2"]])
    write_parquet(tmp_path / "a.csv")
    assert parquet.read_table(tmp_path / "a.parquet").to_pydict() == {
        "id": ["two\nlines", "b", "=1"],
        "length_mm": [1.5, None, 2.0],
    }
    (tmp_path / "b.csv").write_text("", "utf-8")
    write_parquet(tmp_path / "b.csv")
    assert parquet.read_table(tmp_path / "b.parquet").num_columns == 0


def test_without_pyarrow_it_is_refused(monkeypatch):
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    with pytest.raises(MissingPackageError, match=r"lumencut\[parquet\]"):
        check_parquet()


def test_what_speaks_of_all_studies_is_refused_with_one(tmp_path):
    manifest = write_cohort(tmp_path, good=1, bad=False)
    for words, told in (
        (("--one", "good-0", "--retry", "all"), "--retry"),
        (("--check", "--shard", "1/2"), "--shard"),
    ):
        ended = run(manifest, tmp_path / "out", *words)
        assert ended.returncode == 2
        assert f"{told} with {words[0]} does nothing" in ended.stderr
