"""Long tests (``make test-long``): batches, their schedulers and the processes of studies are killed."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path

import pytest

from cohort_scenes import HANGS, command, environment, process, run, table, wait_for, write_cohort
from test_cohort import children_end_with_their_parent, children_of, started

pytestmark = pytest.mark.skipif(os.name != "posix", reason="processes are ended as POSIX does")


@contextmanager
def workers(manifest):
    """Two workers: the address of their scheduler, and their processes."""
    script = Path(__file__).with_name("dask_workers.py")
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.DEVNULL}
    with process([sys.executable, str(script)], env=environment(manifest), text=True, **pipes) as cluster:
        address = cluster.stdout.readline().strip()
        yield address, [int(word) for word in cluster.stdout.readline().split()]


@contextmanager
def scheduler(manifest, folder):
    """A scheduler in its own process, with one worker: its process and its address."""
    place = folder / "scheduler.json"
    place.unlink(missing_ok=True)
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, "env": environment(manifest)}
    words = [sys.executable, "-m", "distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0"]
    words += ["--no-dashboard", "--scheduler-file", str(place)]
    with process(words, **quiet) as begun:
        wait_for(lambda: place.is_file() and place.read_text("utf-8").endswith("}"), begun)
        words = [sys.executable, "-m", "distributed.cli.dask_worker", "--scheduler-file", str(place)]
        words += ["--nthreads", "1", "--no-nanny", "--no-dashboard", "--local-directory", str(folder)]
        with process(words, **quiet):
            yield begun, json.loads(place.read_text("utf-8"))["address"]


def lose_scheduler(manifest, out, moment, number=signal.SIGKILL):
    """Kill the scheduler of a batch at a certain moment; return the output of the batch."""
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    with scheduler(manifest, manifest.parent) as (lost, address):
        words = command(manifest, out, "--dask", address)
        with process(words, env=environment(manifest), **pipes) as batch:
            moment(batch)
            lost.send_signal(number)
            _, told = batch.communicate(timeout=HANGS)
    assert (batch.returncode, "Traceback" in told, "distributed" in told) == (1, False, False), told
    assert told.splitlines()[-1].startswith(f"lumencut: error: dask {address}: found no answer, after ")
    return told


#: Files that exist once the batch has connected, a study works, or a study is done.
CONNECTED, WORKING, DONE = ".lumencut/lock-*", ".lumencut/unfinished/*", "sub-*/*_record.json"


@pytest.fixture(scope="module")
def cohort(tmp_path_factory):
    manifest = write_cohort(tmp_path_factory.mktemp("cohort"), good=3, bad=False)
    whole = manifest.with_name("whole")
    assert run(manifest, whole).returncode == 0
    return manifest, whole


@pytest.mark.parametrize(
    ("sign", "number"),
    [
        (CONNECTED, signal.SIGKILL),
        (WORKING, signal.SIGKILL),
        (DONE, signal.SIGKILL),
        (WORKING, signal.SIGSTOP),
    ],
    ids=["gone before a study", "gone while one works", "gone after one", "hangs"],
)
def test_a_batch_ends_without_its_scheduler_and_goes_on_when_run_again(cohort, tmp_path, sign, number):
    manifest, whole = cohort
    out = tmp_path / "out"
    told = lose_scheduler(manifest, out, lambda batch: wait_for(lambda: list(out.glob(sign)), batch), number)
    assert "expected a scheduler that answers; start it, and run the command again: it continues" in told
    wait_for(lambda: not processes_of(out))
    done = [row["state"] for row in table(out / "studies.csv")].count("done")
    assert done == len(list(out.glob(DONE)))
    again = run(manifest, out)
    assert f"3 done, 0 failed; {3 - done} of them now" in again.stdout
    for name in ("vessels.csv", "sections.csv"):
        assert (out / name).read_bytes() == (whole / name).read_bytes()


def test_a_scheduler_that_hangs_from_the_start_is_refused(tmp_path):
    manifest = write_cohort(tmp_path, good=1, bad=False)
    with scheduler(manifest, tmp_path) as (hung, address):
        hung.send_signal(signal.SIGSTOP)
        ended = run(manifest, tmp_path / "out", "--dask", address)
    assert ended.returncode == 1
    assert "expected the address of a scheduler that answers" in ended.stderr


def test_studies_end_when_their_batch_is_interrupted(tmp_path):
    manifest = write_cohort(tmp_path, good=1)
    manifest.write_text("id,volume\nhanging,hanging.nii.gz\n", "utf-8")
    (tmp_path / "hanging.nii.gz").write_bytes((tmp_path / "tube.nii.gz").read_bytes())
    out = tmp_path / "out"
    with workers(manifest) as (address, _):
        pipes = {"stdout": subprocess.DEVNULL, "stderr": subprocess.PIPE, "text": True}
        told = {"preexec_fn": lambda: signal.signal(signal.SIGINT, signal.default_int_handler)}
        words = command(manifest, out, "--dask", address)
        with process(words, env=environment(manifest), **pipes, **told) as batch:
            wait_for(lambda: list(out.glob(".lumencut/unfinished/*")), batch)
            batch.send_signal(signal.SIGINT)
            batch.communicate(timeout=HANGS)
        assert batch.returncode == 130
        wait_for(lambda: not processes_of(out))
    assert [row["state"] for row in table(out / "studies.csv")] == ["skipped"]


def processes_of(out):
    told = subprocess.run(["ps", "-eo", "args="], capture_output=True, text=True).stdout
    return [line for line in told.splitlines() if f"--output={out}" in line and "--one=" in line]


def test_a_second_batch_into_one_folder_is_refused(tmp_path):
    manifest = write_cohort(tmp_path, good=1)
    out = tmp_path / "out"
    (tmp_path / "studies.csv").write_text("id,volume\nhanging,hanging.nii.gz\n", "utf-8")
    (tmp_path / "hanging.nii.gz").write_bytes((tmp_path / "tube.nii.gz").read_bytes())
    with started(manifest, out) as first:
        wait_for(lambda: list(out.glob(".lumencut/unfinished/*")), first)
        refused = run(manifest, out)
        assert refused.returncode == 1
        assert f"process {first.pid}" in refused.stderr
        assert "another batch" in refused.stderr
        # The lock of a dead process is taken over; here the study is too slow for the second batch as well.
        first.send_signal(signal.SIGKILL)
        first.wait(HANGS)
        assert list(out.glob(".lumencut/lock-*"))
        taken = run(manifest, out, "--time-limit", "3s")
    assert "0 done, 1 failed; 1 of them now" in taken.stdout
    assert not list(out.glob(".lumencut/lock-*"))


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGKILL], ids=lambda one: one.name)
def test_children_end_with_their_parent(tmp_path, number):
    children_end_with_their_parent(tmp_path, number)


@pytest.mark.skipif(sys.platform != "linux", reason="studies are forked on Linux alone")
def test_studies_are_begun_again_where_the_process_that_forks_them_is_lost(tmp_path):
    manifest = write_cohort(tmp_path, good=3, bad=False)
    out = tmp_path / "out"
    with started(manifest, out, "--jobs", "2") as batch:
        wait_for(lambda: len(list(out.glob(".lumencut/unfinished/*"))) == 2, batch)
        (nursery,) = children_of(batch.pid)
        os.kill(nursery, signal.SIGKILL)
        assert batch.wait(HANGS) == 0
    assert [row["state"] for row in table(out / "studies.csv")] == ["done"] * 3
