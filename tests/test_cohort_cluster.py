"""Cohorts on dask.distributed: mistakes are reported before any study starts; kills are in the long tests."""

from __future__ import annotations

import logging
import os
from io import StringIO
from pathlib import Path
from types import SimpleNamespace

import pytest

from cohort_scenes import run, wait_for, write_cohort
from lumencut.cohort import cluster as cluster_room
from lumencut.cohort import scheduler as scheduler_room
from lumencut.cohort.cluster import Cluster, slurm_options
from lumencut.cohort.job import Job
from lumencut.errors import FileError, SettingsError

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


def _silent_watch(monkeypatch, status="running"):
    """A watch whose requests never end, and a clock that the test moves."""
    now = [0.0]
    monkeypatch.setattr(scheduler_room, "time", SimpleNamespace(monotonic=lambda: now[0]))
    loop = SimpleNamespace(add_callback=lambda _: None)
    client = SimpleNamespace(loop=loop, status=status, scheduler=SimpleNamespace(address="tcp://there:1"))
    return now, scheduler_room.SchedulerWatch(client)


def test_a_silent_scheduler_is_lost_even_if_dask_never_ends_a_request(monkeypatch):
    now, watch = _silent_watch(monkeypatch)
    with watch:
        while now[0] < scheduler_room._PATIENCE:
            watch.check(1, 3)
            now[0] += 0.5
        now[0] += 0.5
        lost = "dask tcp://there:1: found no answer, after 1 of 3 studies; expected a scheduler that answers"
        with pytest.raises(FileError, match=lost):
            watch.check(1, 3)
    # The documents state 30 s: with a last request for a result, cancelling and closing.
    assert now[0] + cluster_room._ANSWER + 2 * scheduler_room._GRACE < 30


def test_an_answer_or_a_pause_of_the_batch_itself_loses_no_scheduler(monkeypatch):
    now, watch = _silent_watch(monkeypatch)
    for _ in range(3):
        now[0] += 3600.0
        watch.check(0, 1)
    watch._answers += 1
    for _ in range(3):
        now[0] += 3600.0
        watch.check(0, 1)


def test_a_client_that_gave_up_has_lost_its_scheduler(monkeypatch):
    _, watch = _silent_watch(monkeypatch, status="closing")
    with pytest.raises(FileError, match="found no answer"):
        watch.check(0, 1)


def test_a_batch_does_not_wait_for_dask_to_take_its_studies():
    def sync(_, callback_timeout=None):
        if callback_timeout is None:
            pytest.fail("it would wait without end")
        client.status = "closed"
        raise TimeoutError

    loop = SimpleNamespace(add_callback=lambda _: None)
    scheduler = SimpleNamespace(address="tcp://there:1")
    client = SimpleNamespace(loop=loop, status="running", scheduler=scheduler, sync=sync)
    job = Job("one", ("--version",), Path("log"), 1, None)
    with pytest.raises(FileError, match="after 0 of 1 studies"):
        list(Cluster(client).do([job], Path("lock")))


@pytest.mark.parametrize("is_configured", [False, True])
def test_the_log_of_dask_about_its_connection_is_hidden_unless_the_user_asks_for_it(is_configured):
    pytest.importorskip("distributed")
    dask = pytest.importorskip("dask")
    told = logging.getLogger("distributed")
    shown = logging.StreamHandler(StringIO())
    client = SimpleNamespace(status="running")
    told.addHandler(shown)
    try:
        with dask.config.set({"distributed.logging": {"distributed": "info"} if is_configured else None}):
            with scheduler_room.quiet(client):
                told.getChild("batched").info("Batched Comm Closed")
                told.getChild("core").error("a mistake")
                client.status = "connecting"
                told.getChild("core").error("Failed to reconnect")
            told.getChild("batched").info("later")
    finally:
        told.removeHandler(shown)
    lines = shown.stream.getvalue().split("\n")[:-1]
    expected = ["Batched Comm Closed", "a mistake", "Failed to reconnect", "later"]
    assert lines == (expected if is_configured else expected[1::2])


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
