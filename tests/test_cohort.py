"""``lumencut batch``: a crash affects only its study, no work is repeated, kills leave complete results."""

from __future__ import annotations

import json
import os
import signal
import subprocess

import pytest

import lumencut
from cohort_scenes import (
    BAD,
    HANGS,
    command,
    environment,
    process,
    run,
    table,
    wait_for,
    write_cohort,
)

pytestmark = [
    pytest.mark.skipif(os.name != "posix", reason="processes are ended as POSIX does"),
    pytest.mark.usefixtures("nursery"),
]

LIMITS = ("--memory", "2GB", "--time-limit", "20s", "--jobs", "2", "--threads", "1")


@pytest.fixture(scope="module")
def done(tmp_path_factory):
    """A cohort of ten studies, five of which must fail, and the result of its batch."""
    manifest = write_cohort(tmp_path_factory.mktemp("cohort"), good=5)
    out = manifest.with_name("out")
    return manifest, out, run(manifest, out, *LIMITS)


def test_five_bad_studies_of_ten_take_nobody_with_them(done):
    _, out, ended = done
    rows = {row["id"]: row for row in table(out / "studies.csv")}
    assert len(rows) == 10
    failed = {name: row["reason"] for name, row in rows.items() if row["state"] == "failed"}
    assert set(failed) == set(BAD), ended.stderr
    for name, words in BAD.items():
        assert words in failed[name], failed
    good = [row for row in rows.values() if row["state"] == "done"]
    assert len(good) == 5
    assert all(row["reason"] == "" and float(row["seconds"]) > 0 for row in good)
    assert ended.returncode == 3
    assert "5 done, 5 failed" in ended.stdout


def test_tables_hold_the_good_studies_in_the_order_of_the_manifest(done):
    manifest, out, _ = done
    order = [row["id"] for row in table(manifest)]
    assert [row["id"] for row in table(out / "studies.csv")] == order
    good = [name for name in order if name not in BAD]
    for name in ("vessels", "sections"):
        rows = table(out / f"{name}.csv")
        seen = list(dict.fromkeys(row["id"] for row in rows))
        assert seen == good
    sections = table(out / "sections.csv")
    assert {row["centerlines_from"] for row in sections if row["id"] == good[0]} == {"none"}
    assert {row["centerlines_from"] for row in sections if row["id"] == good[1]} == {"centerlines"}
    assert all(row["uncertainty_mm"] and row["fwhm_source"] and row["wall_source"] for row in sections)
    measured = [float(row["diameter_median_mm"]) for row in table(out / "vessels.csv")]
    assert all(abs(diameter - 6) < 0.5 for diameter in measured), measured


def test_further_columns_are_carried_along(done):
    manifest, out, _ = done
    ages = {row["id"]: row["age"] for row in table(manifest)}
    assert {row["id"]: row["age"] for row in table(out / "studies.csv")} == ages


def test_the_tables_are_those_of_each_study_alone(done):
    _, out, _ = done
    text = (out / "sections.csv").read_text("utf-8").splitlines()
    part = (out / "sub-good3/sub-good3_sections.csv").read_text("utf-8").splitlines()
    assert part[0] == text[0]
    assert set(part[1:]) <= set(text)


def test_the_second_run_does_nothing(done):
    manifest, out, _ = done
    before = {path: path.stat().st_mtime_ns for path in out.glob("sub-*/*")}
    assert before
    again = run(manifest, out, *LIMITS)
    assert "0 of them now" in again.stdout
    assert again.returncode == 3
    assert {path: path.stat().st_mtime_ns for path in out.glob("sub-*/*")} == before


def test_only_what_failed_or_changed_is_done_again(tmp_path):
    manifest = write_cohort(tmp_path, good=2, bad=False)
    kept = (tmp_path / "good-0.nii.gz").rename(tmp_path / "kept")
    out = tmp_path / "out"
    assert run(manifest, out).returncode == 3
    again = run(manifest, out, "--retry", "failed")
    assert "1 of them now" in again.stdout
    assert again.returncode == 3
    kept.rename(tmp_path / "good-0.nii.gz")
    assert "1 of them now" in run(manifest, out).stdout
    assert not list((out / ".lumencut/failed").iterdir())
    os.utime(tmp_path / "good-1.nii.gz", (1, 1))
    again = run(manifest, out)
    assert "1 of them now" in again.stdout
    assert again.returncode == 0


def test_results_of_another_recipe_or_a_newer_version_are_not_mixed(tmp_path):
    manifest = write_cohort(tmp_path, good=1, bad=False)
    out = tmp_path / "out"
    assert run(manifest, out).returncode == 0
    (tmp_path / "recipe.toml").write_text("[pictures]\nviews = []\n[measure]\nstep = 1.0\n", "utf-8")
    refused = run(manifest, out)
    assert refused.returncode == 1
    assert "results of another recipe" in refused.stderr
    assert "--retry all" in refused.stderr
    before = len(table(out / "sections.csv"))
    assert run(manifest, out, "--retry", "all").returncode == 0
    assert len(table(out / "sections.csv")) > 1.5 * before
    assert "0 of them now" in run(manifest, out).stdout
    (record,) = out.glob("sub-*/*_record.json")
    record.write_text(json.dumps({**json.loads(record.read_text("utf-8")), "format": 2}), "utf-8")
    refused = run(manifest, out)
    assert refused.returncode == 1
    assert "of a newer version of Lumencut" in refused.stderr


def test_children_end_with_their_parent(tmp_path):
    children_end_with_their_parent(tmp_path, signal.SIGTERM)


def children_end_with_their_parent(tmp_path, number):
    manifest = write_cohort(tmp_path, good=1)
    (tmp_path / "studies.csv").write_text("id,volume\nhanging,hanging.nii.gz\n", "utf-8")
    (tmp_path / "hanging.nii.gz").write_bytes((tmp_path / "tube.nii.gz").read_bytes())
    out = tmp_path / "out"
    with started(manifest, out) as batch:
        wait_for(lambda: list(out.glob(".lumencut/unfinished/*")), batch)
        (nursery,) = children_of(batch.pid)
        children = [nursery, *children_of(nursery)]
        assert len(children) == 2
        batch.send_signal(number)
        code = batch.wait(HANGS)
    wait_for(lambda: not any(map(is_there, children)))
    assert code == {signal.SIGINT: 130, signal.SIGTERM: 143, signal.SIGKILL: -9}[number]
    if number != signal.SIGKILL:
        assert not list(out.glob(".lumencut/lock-*"))
        assert [row["state"] for row in table(out / "studies.csv")] == ["skipped"]


def test_a_full_disk_ends_the_batch_and_blames_no_study(tmp_path):
    manifest = write_cohort(tmp_path, good=2, bad=False)
    text = "id,volume\ngood-0,good-0.nii.gz\nfull,good-1.nii.gz\ngood-1,good-1.nii.gz\n"
    manifest.write_text(text, "utf-8")
    out = tmp_path / "out"
    ended = run(manifest, out)
    assert ended.returncode == 1
    assert "found no room left on the disk" in ended.stderr
    assert [row["state"] for row in table(out / "studies.csv")] == ["done", "skipped", "skipped"]
    assert not list(out.glob(".lumencut/unfinished/*"))
    (out / "room").touch()
    again = run(manifest, out)
    assert "2 of them now" in again.stdout
    assert again.returncode == 0


def test_a_study_alone_is_done_in_this_process(tmp_path):
    manifest = write_cohort(tmp_path, good=2, bad=False)
    out = tmp_path / "out"
    ended = run(manifest, out, "--one", "good-1")
    assert (ended.returncode, ended.stdout) == (0, "good-1: done\n")
    assert [path.name for path in out.glob("sub-*")] == ["sub-good1"]
    refused = run(manifest, out, "--one", "nobody")
    assert refused.returncode == 2
    assert "no study 'nobody'" in refused.stderr
    assert "1 of them now" in run(manifest, out).stdout


def test_a_batch_from_python(tmp_path):
    manifest = write_cohort(tmp_path, good=2, bad=False)
    (tmp_path / "good-1.nii.gz").unlink()
    told = []
    summary = lumencut.batch(
        manifest,
        tmp_path / "out",
        recipe=tmp_path / "recipe.toml",
        progress=lambda done, total, outcome: told.append((done, total, outcome.id, outcome.state)),
    )
    assert (summary.done, summary.failed, summary.skipped, summary.worked) == (1, 1, 0, 2)
    assert told == [(1, 2, "good-0", "done"), (2, 2, "good-1", "failed")]


def started(manifest, out, *words):
    """Start a batch, and kill it when the test ends."""
    # If the tests run in the background, their processes may ignore Ctrl-C.
    told = {"preexec_fn": lambda: signal.signal(signal.SIGINT, signal.default_int_handler)}
    pipes = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    return process(command(manifest, out, *words), env=environment(manifest), **pipes, **told)


def children_of(process):
    told = subprocess.run(["ps", "-o", "pid=", "--ppid", str(process)], capture_output=True, text=True)
    return [int(word) for word in told.stdout.split()]


def is_there(process):
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    return True
