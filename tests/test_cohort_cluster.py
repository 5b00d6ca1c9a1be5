"""Cohorts on dask.distributed: studies end with their batch, and mistakes are told before any of them."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path

import pytest

from cohort_scenes import command, environment, run, table, wait_for, write_cohort
from lumencut.cohort.cluster import slurm_options
from lumencut.errors import SettingsError

pytestmark = pytest.mark.skipif(os.name != "posix", reason="processes are ended as POSIX does")


@contextmanager
def workers(manifest):
    """Two workers: the address of their scheduler, and their processes."""
    script = Path(__file__).with_name("dask_workers.py")
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.DEVNULL}
    with subprocess.Popen(
        [sys.executable, str(script)], env=environment(manifest), text=True, **pipes
    ) as process:
        try:
            address = process.stdout.readline().strip()
            yield address, [int(word) for word in process.stdout.readline().split()]
        finally:
            process.stdin.close()
            process.wait(60)


def test_studies_end_when_their_batch_is_interrupted(tmp_path):
    manifest = write_cohort(tmp_path, good=1)
    manifest.write_text("id,volume\nhanging,hanging.nii.gz\n", "utf-8")
    (tmp_path / "hanging.nii.gz").write_bytes((tmp_path / "tube.nii.gz").read_bytes())
    out = tmp_path / "out"
    with workers(manifest) as (address, _):
        pipes = {"stdout": subprocess.DEVNULL, "stderr": subprocess.PIPE, "text": True}
        told = {"preexec_fn": lambda: signal.signal(signal.SIGINT, signal.default_int_handler)}
        words = command(manifest, out, "--dask", address)
        with subprocess.Popen(words, env=environment(manifest), **pipes, **told) as batch:
            wait_for(lambda: list(out.glob(".lumencut/unfinished/*")), batch)
            batch.send_signal(signal.SIGINT)
            batch.communicate(timeout=60)
        assert batch.returncode == 130
        wait_for(lambda: not processes_of(out))
    assert [row["state"] for row in table(out / "studies.csv")] == ["skipped"]


def processes_of(out):
    """The processes of studies of a cohort."""
    told = subprocess.run(["ps", "-eo", "args="], capture_output=True, text=True).stdout
    return [line for line in told.splitlines() if f"--output={out}" in line and "--one=" in line]


def test_an_address_without_a_scheduler_is_refused(tmp_path):
    manifest = write_cohort(tmp_path, good=1, bad=False)
    ended = run(manifest, tmp_path / "out", "--dask", "127.0.0.1:9")
    assert ended.returncode == 1
    assert "expected the address of a scheduler that answers" in ended.stderr
    both = run(manifest, tmp_path / "out", "--dask", "127.0.0.1:9", "--slurm", "cores=2")
    assert "expected one of them" in both.stderr


def test_a_job_of_slurm_does_one_study_with_all_its_cores():
    jobqueue = pytest.importorskip("dask_jobqueue")
    options = slurm_options("partition=long,memory=8GB,walltime=24:00:00,cores=2,skip=--mem")
    with jobqueue.SLURMCluster(**options) as cluster:
        script = cluster.job_script()
    assert "#SBATCH -p long" in script
    assert "#SBATCH --cpus-per-task=2" in script
    assert "#SBATCH -t 24:00:00" in script
    assert "#SBATCH --mem" not in script
    assert script.rindex("--nthreads 1") > script.rindex("--nthreads 2")
    assert "--memory-limit 0" in script


@pytest.mark.parametrize("options", ["queue=long", "partition", "cores=two", "memory="])
def test_unknown_options_of_slurm_are_refused(options):
    with pytest.raises(SettingsError, match="slurm"):
        slurm_options(options)
