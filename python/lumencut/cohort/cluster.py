"""Studies on the workers of dask.distributed, which start the processes and say how they ended."""

from __future__ import annotations

import os
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from lumencut.cohort.child import Child, Outcome
from lumencut.cohort.job import Job
from lumencut.errors import MissingPackageError, SettingsError

#: A study whose worker was lost is begun again on another one so many times.
_LOST_WORKERS = 5
#: How often a worker looks whether the batch is still there (s), and the batch whether a study has ended.
_LOOK, _TICK = 1.0, 1.0
#: What ``--slurm`` takes, by what dask-jobqueue calls it.
SLURM_NAMES = {
    "partition": "queue",
    "account": "account",
    "walltime": "walltime",
    "memory": "memory",
    "cores": "cores",
    "skip": "job_directives_skip",
}


@dataclass(frozen=True)
class Cluster:
    """Workers that do studies.

    Attributes
    ----------
    client : distributed.Client
        The way to their scheduler.
    """

    client: Any

    def do(self, jobs: Sequence[Job], lock: Path) -> Iterator[Outcome | None]:
        """Do jobs on all workers, and yield how each ended, as `side_by_side` does.

        A study whose worker or machine is lost is begun again elsewhere; one that crashes is not. Workers end
        the processes of their studies when the lock of the batch is gone.
        """
        distributed = _package("distributed", "dask.distributed")
        by_key: dict[str, Job] = {}
        lost: dict[str, int] = {}
        asked = [self._begin(job, lock, by_key) for job in jobs]
        running = distributed.as_completed(asked, loop=self.client.loop)
        try:
            while not running.is_empty():
                if not running.has_ready():
                    time.sleep(_TICK / 10)
                    yield None
                    continue
                for future in running.next_batch(block=False):
                    job = by_key.pop(future.key)
                    outcome = _outcome(future, job, lost)
                    if outcome is None:
                        running.add(self._begin(job, lock, by_key))
                        continue
                    if outcome.state == "no room":
                        self.client.cancel(list(running.futures))
                    yield outcome
                    if outcome.state == "no room":
                        return
        finally:
            self.client.cancel(list(running.futures))

    def _begin(self, job: Job, lock: Path, by_key: dict[str, Job]) -> Any:
        """Hand a job to the scheduler."""
        future = self.client.submit(run_on_worker, job, str(lock), key=f"lumencut-study-{job.id}-{_token()}")
        by_key[future.key] = job
        return future


def _token() -> str:
    return os.urandom(4).hex()


def _outcome(future: Any, job: Job, lost: dict[str, int]) -> Outcome | None:
    """How a study ended; None where it is to be begun again, as its worker was lost."""
    if future.status == "finished":
        outcome: Outcome = future.result()
        return outcome
    lost[job.id] = lost.get(job.id, 0) + 1
    if lost[job.id] <= _LOST_WORKERS:
        return None
    reason = f"its worker was lost {lost[job.id]} times" if future.cancelled() else repr(future.exception())
    return Outcome(job.id, "failed", reason, 0.0)


def run_on_worker(job: Job, lock: str) -> Outcome:
    """Do a study in a process of its own on a worker, with a fair part of its cores."""
    distributed = _package("distributed", "dask.distributed")
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    threads = job.threads or max(1, cores // distributed.get_worker().state.nthreads)
    child = Child(replace(job, threads=threads))
    looked = time.monotonic()
    try:
        while (outcome := child.outcome()) is None:
            time.sleep(0.05)
            if time.monotonic() - looked > _LOOK:
                looked = time.monotonic()
                if not os.path.exists(lock):
                    return Outcome(job.id, "failed", "the batch was ended", 0.0)
        return outcome
    finally:
        child.end()
        child.wait()


@contextmanager
def dask_cluster(address: str) -> Iterator[Cluster]:
    """Connect to the scheduler of a cluster of dask.distributed.

    Raises
    ------
    MissingPackageError
        Without dask.distributed.
    SettingsError
        Where no scheduler answers.
    """
    distributed = _package("distributed", "dask.distributed")
    try:
        client = distributed.Client(address, timeout=10, set_as_default=False)
    except (OSError, ValueError) as error:
        found = str(error) or type(error).__name__
        raise SettingsError(f"dask {address}", found, "the address of a scheduler that answers") from error
    with client:
        yield Cluster(client)


@contextmanager
def slurm_cluster(options: str, jobs: int) -> Iterator[Cluster]:
    """Start workers as jobs of SLURM, and end them with the batch.

    Parameters
    ----------
    options : str
        Such as ``partition=long,memory=8GB,walltime=24:00:00,cores=2``; see `SLURM_NAMES`.
    jobs : int
        How many jobs, each with one worker.

    Raises
    ------
    MissingPackageError
        Without dask-jobqueue.
    SettingsError
        For other options.
    """
    given = slurm_options(options)
    distributed = _package("distributed", "dask.distributed")
    jobqueue = _package("dask_jobqueue", "dask-jobqueue")
    with (
        jobqueue.SLURMCluster(**given) as cluster,
        distributed.Client(cluster, set_as_default=False) as client,
    ):
        # Jobs that end, by their time or with their node, are begun again.
        cluster.adapt(minimum_jobs=jobs, maximum_jobs=jobs)
        yield Cluster(client)


def slurm_options(options: str) -> dict[str, Any]:
    """Return what a SLURMCluster takes: one study at a time in each job, its dashboard on loopback alone.

    Raises
    ------
    SettingsError
        For unknown options, and values that are none.
    """
    made: dict[str, Any] = {"cores": 1, "memory": "4GB"}
    for part in filter(None, options.split(",")):
        name, equals, value = part.partition("=")
        if name not in SLURM_NAMES or not equals or not value:
            expected = f"{'=…, '.join(SLURM_NAMES)}=…, with commas between them"
            raise SettingsError("slurm", f"{part!r:.80}", expected)
        made[SLURM_NAMES[name]] = value
    try:
        made["cores"] = int(made["cores"])
    except ValueError:
        raise SettingsError("slurm", f"cores={made['cores']!r:.40}", "a whole number of cores") from None
    if "job_directives_skip" in made:
        made["job_directives_skip"] = made["job_directives_skip"].split()
    made["scheduler_options"] = {"dashboard_address": "127.0.0.1:0"}
    # One thread of the worker starts one study, which has all cores and all memory of the job.
    made |= {
        "processes": 1,
        "worker_extra_args": ["--nthreads", "1", "--memory-limit", "0", "--no-dashboard"],
    }
    return made


def _package(module: str, name: str) -> Any:
    import importlib

    try:
        return importlib.import_module(module)
    except ImportError as error:
        mend = "pip install lumencut[cluster]"
        raise MissingPackageError(name, "no such package", "the extra [cluster]", mend) from error
