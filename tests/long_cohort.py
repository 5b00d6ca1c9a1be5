"""Long tests of cohorts (``make test-long``): 200 studies, 20 kills of a batch and its scheduler, SLURM."""

from __future__ import annotations

import os
import random
import shlex
import signal
import subprocess
import time

import pytest

from cohort_scenes import HANGS, command, environment, process, run, table, wait_for, write_cohort
from long_cluster import CONNECTED, lose_scheduler, workers
from slurm_node import is_there, slurm
from test_cohort import started

TABLES = ("vessels.csv", "sections.csv")


def test_twenty_kills_of_a_batch_of_two_hundred_studies_change_nothing(tmp_path):
    manifest = write_cohort(tmp_path, good=200, bad=False)
    whole, killed = tmp_path / "whole", tmp_path / "killed"
    words = ("--jobs", "2", "--threads", "1")
    assert run(manifest, whole, *words).returncode == 0
    moments = random.Random(11)
    for _ in range(20):
        pipes = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        with process(command(manifest, killed, *words), env=environment(manifest), **pipes):
            time.sleep(moments.uniform(1.0, 5.0))
        for folder in killed.glob("sub-*"):
            assert len(list(folder.glob("*_record.json"))) == 1
    assert run(manifest, killed, *words).returncode == 0
    assert [row["state"] for row in table(killed / "studies.csv")] == ["done"] * 200
    assert list(killed.glob(".lumencut/unfinished/*")) == []
    for name in TABLES:
        assert (killed / name).read_bytes() == (whole / name).read_bytes()


def test_shards_share_a_folder(tmp_path):
    manifest = write_cohort(tmp_path, good=5, bad=False)
    out, whole = tmp_path / "out", tmp_path / "whole"
    with started(manifest, out, "--shard", "1/2") as first:
        second = run(manifest, out, "--shard", "2/2")
        assert first.wait(HANGS) == 0
    assert second.returncode == 0
    assert "2 of them now" in second.stdout
    assert run(manifest, whole).returncode == 0
    rows = table(out / "studies.csv")
    assert [row["state"] for row in rows] == ["done"] * 5
    assert (out / "sections.csv").read_bytes() == (whole / "sections.csv").read_bytes()


def test_a_lost_worker_loses_no_study_and_a_crash_takes_nobody_with_it(tmp_path):
    manifest = write_cohort(tmp_path, good=5)
    text = manifest.read_text("utf-8").splitlines()
    kept = [line for line in text if not line.startswith(("hanging", "greedy"))]
    manifest.write_text("\n".join(kept) + "\n", "utf-8")
    here, there = tmp_path / "here", tmp_path / "there"
    assert run(manifest, here, "--jobs", "2").returncode == 3
    with workers(manifest) as (address, processes):
        assert len(processes) == 2
        words = command(manifest, there, "--dask", address)
        pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
        with process(words, env=environment(manifest), **pipes) as batch:
            wait_for(lambda: len(list(there.glob(".lumencut/unfinished/*"))) == 2, batch)
            os.kill(processes[0], signal.SIGKILL)
            told, complaints = batch.communicate(timeout=HANGS)
    assert batch.returncode == 3, complaints
    assert "5 done, 3 failed; 8 of them now" in told
    for name in ("vessels.csv", "sections.csv"):
        assert (there / name).read_bytes() == (here / name).read_bytes()
    for name in ("id", "state", "reason", "vessels"):
        first, second = ([row[name] for row in table(out / "studies.csv")] for out in (here, there))
        assert first == second


def test_twenty_kills_of_a_scheduler_end_each_batch_and_lose_no_study(tmp_path):
    manifest = write_cohort(tmp_path, good=120, bad=False)
    whole, killed = tmp_path / "whole", tmp_path / "killed"
    assert run(manifest, whole, "--jobs", "2").returncode == 0
    moments = random.Random(13)

    def comes(batch):
        wait_for(lambda: list(killed.glob(CONNECTED)), batch)
        time.sleep(moments.uniform(0.0, 6.0))

    done = 0
    for trial in range(20):
        told = lose_scheduler(manifest, killed, comes, signal.SIGSTOP if trial % 5 == 4 else signal.SIGKILL)
        assert "expected a scheduler that answers" in told
        assert len(list(killed.glob("sub-*/*_record.json"))) >= done
        done = len(list(killed.glob("sub-*/*_record.json")))
    assert run(manifest, killed, "--jobs", "2").returncode == 0
    for name in TABLES:
        assert (killed / name).read_bytes() == (whole / name).read_bytes()


@pytest.fixture(scope="module")
def node(tmp_path_factory):
    """The environment for SLURM with one node."""
    if not is_there():
        pytest.skip("needs root and the packages slurm-wlm and munge of Debian")
    with slurm(tmp_path_factory.mktemp("slurm")) as found:
        yield found


@pytest.fixture(scope="module")
def cohort(tmp_path_factory):
    """A cohort, and its results computed on this machine."""
    manifest = write_cohort(tmp_path_factory.mktemp("cohort"), good=6, bad=False)
    here = manifest.with_name("here")
    assert run(manifest, here).returncode == 0
    return manifest, here


def test_an_array_of_slurm_gives_the_same_tables(node, cohort):
    manifest, here = cohort
    out = manifest.with_name("array")
    words = f"{shlex.join(command(manifest, out))} --shard $SLURM_ARRAY_TASK_ID/4"
    asked = ["sbatch", "--wait", "--array=1-4", "--mem=1000", "--output=/dev/null", "--wrap", words]
    ended = subprocess.run(
        asked, env=environment(manifest) | node, capture_output=True, text=True, timeout=HANGS
    )
    assert ended.returncode == 0, ended.stderr
    assert [row["state"] for row in table(out / "studies.csv")] == ["done"] * 6
    for name in TABLES:
        assert (out / name).read_bytes() == (here / name).read_bytes()


def test_a_lost_job_of_slurm_loses_no_study(node, cohort):
    manifest, here = cohort
    out = manifest.with_name("slurm")
    options = "partition=long,memory=2GB,walltime=01:00:00,cores=1"
    words = command(manifest, out, "--slurm", options, "--jobs", "2")
    where = environment(manifest) | node
    with process(words, env=where, cwd=manifest.parent) as batch:
        wait_for(lambda: list(out.glob(".lumencut/unfinished/*")), batch)
        jobs = subprocess.run(["squeue", "-h", "-o", "%A"], env=where, capture_output=True, text=True)
        subprocess.run(["scancel", jobs.stdout.split()[0]], env=where, check=True)
        assert batch.wait(HANGS) == 0
    for name in TABLES:
        assert (out / name).read_bytes() == (here / name).read_bytes()
