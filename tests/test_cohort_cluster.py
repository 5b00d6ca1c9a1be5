"""Cohorts on dask.distributed: mistakes are reported before any study starts; kills are in the long tests."""

from __future__ import annotations

import os

import pytest

from cohort_scenes import run, wait_for, write_cohort
from lumencut.cohort import scheduler as scheduler_room
from lumencut.cohort.cluster import slurm_options
from lumencut.errors import SettingsError

pytestmark = pytest.mark.skipif(os.name != "posix", reason="processes are ended as POSIX does")


def test_a_batch_says_that_no_worker_is_there(monkeypatch, caplog):
    distributed = pytest.importorskip("distributed")
    monkeypatch.setattr(scheduler_room, "_IDLE", 0.1)
    monkeypatch.setattr(scheduler_room, "_EVERY", 0.1)
    alone = {"n_workers": 0, "processes": False, "dashboard_address": ":0"}
    with (
        distributed.LocalCluster(**alone) as cluster,
        distributed.Client(cluster, set_as_default=False) as client,
        scheduler_room.SchedulerWatch(client) as watch,
    ):
        wait_for(lambda: "it has no workers; the batch waits until some come" in caplog.text)
        watch.check(0, 1)


def test_an_address_without_a_scheduler_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr("lumencut.cohort.cluster._CONNECTING", 1.0)
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
