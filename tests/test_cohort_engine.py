"""Studies in parallel: the end of each process is reported, however the process was started."""

from __future__ import annotations

import os
import signal
import sys

import pytest

from cohort_scenes import any_nursery
from lumencut.cli import batch_progress
from lumencut.cohort import engine
from lumencut.cohort.child import Outcome
from lumencut.cohort.engine import side_by_side
from lumencut.cohort.job import Job
from lumencut.cohort.nursery import Nursery, NurseryError

pytestmark = pytest.mark.skipif(os.name != "posix", reason="processes are ended as POSIX does")


def jobs_of(folder, *words):
    return [Job(f"job-{n}", one, folder / f"{n}.log", 1, 60.0) for n, one in enumerate(words)]


def outcomes(jobs, count=2):
    return {one.id: one for one in side_by_side(jobs, count) if one is not None}


@pytest.fixture
def forked(nursery, monkeypatch):
    """Fork all studies from one process."""
    monkeypatch.setattr(engine, "Nursery", any_nursery)


@pytest.fixture(params=["forked", "fresh"])
def way(request, monkeypatch):
    """Both methods to start a process."""
    if request.param == "fresh":
        monkeypatch.setattr(engine, "Nursery", _Broken)
    elif sys.platform != "linux":
        pytest.skip("studies are forked on Linux alone")
    else:
        request.getfixturevalue("forked")
    return request.param


class _Broken(Nursery):
    """A forking process that ends before it forks anything."""

    def start(self, job):
        raise NurseryError


@pytest.mark.usefixtures("way")
def test_ends_are_told_by_code_and_last_words(tmp_path):
    found = outcomes(jobs_of(tmp_path, ("--version",), ("batch",), ("render", "none.nii", "-o", "a.png")))
    assert [found[f"job-{n}"].state for n in range(3)] == ["done", "failed", "failed"]
    assert (tmp_path / "0.log").read_text("utf-8").startswith("lumencut ")
    assert "Missing argument" in found["job-1"].reason
    assert found["job-2"].reason.startswith("none.nii: found no such file")


class _Lost(Nursery):
    """A forking process that is lost after its first fork."""

    def start(self, job):
        forked = super().start(job)
        self._process.kill()
        return forked


class _Stuck(Nursery):
    """A forking process that is stopped before it forks anything."""

    def __init__(self):
        super().__init__()
        self._process.send_signal(signal.SIGSTOP)


@pytest.mark.skipif(sys.platform != "linux", reason="studies are forked on Linux alone")
def test_studies_get_new_processes_where_the_process_that_forks_them_is_stuck(tmp_path, monkeypatch):
    monkeypatch.setattr("lumencut.cohort.nursery.LONGEST_BIRTH", 0.0)
    monkeypatch.setattr(engine, "Nursery", _Stuck)
    found = outcomes(jobs_of(tmp_path, ("--version",)))
    assert found["job-0"].state == "done"


@pytest.mark.skipif(sys.platform != "linux", reason="studies are forked on Linux alone")
@pytest.mark.usefixtures("nursery")
def test_studies_are_begun_again_where_the_process_that_forks_them_is_lost(tmp_path, monkeypatch):
    begun = [any_nursery, _Lost]
    monkeypatch.setattr(engine, "Nursery", lambda: begun.pop()())
    found = outcomes(jobs_of(tmp_path, *[("--version",)] * 3))
    assert [one.state for one in found.values()] == ["done"] * 3
    assert begun == []


@pytest.mark.usefixtures("way")
def test_no_more_work_at_once_than_is_asked_for(tmp_path):
    begun = outcomes(jobs_of(tmp_path, *[("--version",)] * 3), count=1)
    assert [one.state for one in begun.values()] == ["done"] * 3
    # One after the other, in the requested order.
    assert list(begun) == [f"job-{n}" for n in range(3)]


@pytest.mark.usefixtures("forked")
@pytest.mark.parametrize(("tick", "has_turns"), [(0.0, True), (1e9, False)])
def test_the_caller_has_a_turn_now_and_then(tmp_path, monkeypatch, tick, has_turns):
    monkeypatch.setattr(engine, "_TICK", tick)
    found = list(side_by_side(jobs_of(tmp_path, ("--version",)), 1))
    assert (None in found) == has_turns


def test_without_a_terminal_a_line_now_and_then_tells_how_far_it_is(monkeypatch, capsys):
    moments = iter([0.0, 30.0, 90.0, 100.0, 180.0])
    monkeypatch.setattr(batch_progress.time, "monotonic", lambda: next(moments))
    with batch_progress.batch_progress() as told:
        for done, state in enumerate(("done", "failed", "done", "done"), 1):
            told(done, 4, Outcome(f"p{done}", state, "crashed: SIGABRT" if state == "failed" else "", 1.0))
    lines = capsys.readouterr().err.splitlines()
    assert lines == ["p2: failed: crashed: SIGABRT", "2 of 4 studies, 1 failed, 80 an hour, about 2 min left"]


def test_no_jobs_start_nothing(tmp_path, monkeypatch):
    monkeypatch.setattr(engine, "Nursery", None)
    assert list(side_by_side([], 2)) == []
