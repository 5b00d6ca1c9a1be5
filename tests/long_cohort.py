"""Cohorts that take minutes, for ``make test-long``: 200 studies and 20 kills, and SLURM of one node."""

from __future__ import annotations

import random
import shlex
import signal
import subprocess
import time

import pytest

from cohort_scenes import command, environment, run, table, wait_for, write_cohort
from slurm_node import is_there, slurm

TABLES = ("vessels.csv", "sections.csv")


def test_twenty_kills_of_a_batch_of_two_hundred_studies_change_nothing(tmp_path):
    manifest = write_cohort(tmp_path, good=200, bad=False)
    whole, killed = tmp_path / "whole", tmp_path / "killed"
    words = ("--jobs", "2", "--threads", "1")
    assert run(manifest, whole, *words).returncode == 0
    moments = random.Random(11)
    for _ in range(20):
        pipes = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        with subprocess.Popen(command(manifest, killed, *words), env=environment(manifest), **pipes) as batch:
            time.sleep(moments.uniform(1.0, 5.0))
            batch.send_signal(signal.SIGKILL)
        for folder in killed.glob("sub-*"):
            assert len(list(folder.glob("*_record.json"))) == 1
    assert run(manifest, killed, *words).returncode == 0
    assert [row["state"] for row in table(killed / "studies.csv")] == ["done"] * 200
    for name in TABLES:
        assert (killed / name).read_bytes() == (whole / name).read_bytes()


@pytest.fixture(scope="module")
def node(tmp_path_factory):
    """The environment of SLURM of one node."""
    if not is_there():
        pytest.skip("needs root and the packages slurm-wlm and munge of Debian")
    with slurm(tmp_path_factory.mktemp("slurm")) as found:
        yield found


@pytest.fixture(scope="module")
def cohort(tmp_path_factory):
    """A cohort, and its results on this machine alone."""
    manifest = write_cohort(tmp_path_factory.mktemp("cohort"), good=6, bad=False)
    here = manifest.with_name("here")
    assert run(manifest, here).returncode == 0
    return manifest, here


def test_an_array_of_slurm_gives_the_same_tables(node, cohort):
    manifest, here = cohort
    out = manifest.with_name("array")
    words = f"{shlex.join(command(manifest, out))} --shard $SLURM_ARRAY_TASK_ID/4"
    asked = ["sbatch", "--wait", "--array=1-4", "--mem=1000", "--output=/dev/null", "--wrap", words]
    ended = subprocess.run(asked, env=environment(manifest) | node, capture_output=True, text=True)
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
    with subprocess.Popen(words, env=where, cwd=manifest.parent) as batch:
        wait_for(lambda: list(out.glob(".lumencut/unfinished/*")), batch)
        jobs = subprocess.run(["squeue", "-h", "-o", "%A"], env=where, capture_output=True, text=True)
        subprocess.run(["scancel", jobs.stdout.split()[0]], env=where, check=True)
        assert batch.wait(300) == 0
    for name in TABLES:
        assert (out / name).read_bytes() == (here / name).read_bytes()
