"""Runs studies on the workers of dask.distributed; a worker starts a process per study."""

from __future__ import annotations

import asyncio
import concurrent.futures
import os
import time
from collections import Counter, deque
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from lumencut.base.cores import usable_cores
from lumencut.cohort.child import Child, Outcome
from lumencut.cohort.job import Job
from lumencut.cohort.scheduler import SchedulerWatch, briefly, quiet, within
from lumencut.errors import MissingPackageError, SettingsError

#: How often a study restarts on another worker if its worker is lost.
_LOST_WORKERS = 5
#: Intervals at which the batch checks its studies, and at which a worker checks the batch (s).
_LOOK, _LOOK_FOR_BATCH = 0.1, 1.0
#: Timeouts for connecting, and for the result of a study that has ended (s).
_CONNECTING, _ANSWER = 10.0, 5.0
_ENDED = ("finished", "error", "cancelled")
#: Options of ``--slurm``, with their names in dask-jobqueue.
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
    """The workers that process studies.

    Attributes
    ----------
    client : distributed.Client
        A client that is connected to their scheduler.
    """

    client: Any

    def do(self, jobs: Sequence[Job], lock: Path) -> Iterator[Outcome | None]:
        """Run jobs on all workers, and yield how each ended, like `side_by_side`.

        A study restarts on another worker if its worker or machine is lost, but not if it crashes. Workers
        processes of their studies when the lock of the batch is gone.

        Raises
        ------
        FileError
            If the scheduler no longer answers.
        """
        studies = _Studies(self.client, jobs, str(lock))
        try:
            with SchedulerWatch(self.client) as watch:
                has_room = True
                while studies.left and has_room:
                    studies.begin()
                    for future in studies.ended():
                        # Each result may take until its timeout.
                        watch.check(len(jobs) - studies.left, len(jobs))
                        outcome = studies.outcome(future)
                        has_room = has_room and (outcome is None or outcome.state != "no room")
                        yield outcome
                    watch.check(len(jobs) - studies.left, len(jobs))
                    time.sleep(_LOOK)
                    yield None
        finally:
            briefly(studies.cancel)


class _Studies:
    """The studies that have not ended: some wait, others were submitted to the scheduler."""

    def __init__(self, client: Any, jobs: Sequence[Job], lock: str) -> None:
        self._client, self._lock = client, lock
        self._waiting = deque(jobs)
        self._asked: dict[Any, Job] = {}
        self._lost: Counter[str] = Counter()

    @property
    def left(self) -> int:
        """Their number."""
        return len(self._waiting) + len(self._asked)

    def begin(self) -> None:
        """Submit the waiting studies to the scheduler."""
        if self._waiting:
            # What dask has not submitted in time it submits later, or the check of the scheduler ends this.
            with suppress(TimeoutError):
                self._client.sync(self._submit, callback_timeout=_ANSWER)

    async def _submit(self) -> None:
        # In the event loop of dask: if the connection broke in between, dask would forget the studies.
        while self._waiting and self._client.status == "running":
            job = self._waiting[0]
            key = f"lumencut-study-{job.id}-{os.urandom(4).hex()}"
            self._asked[self._client.submit(run_on_worker, job, self._lock, key=key)] = job
            self._waiting.popleft()

    def ended(self) -> list[Any]:
        """Return the submitted studies that ended."""
        return [future for future in list(self._asked) if future.status in _ENDED]

    def outcome(self, future: Any) -> Outcome | None:
        """Return how a study ended; None if it restarts or its end is not known yet."""
        try:
            outcome: Outcome | None = future.result(_ANSWER)
        except (Exception, asyncio.CancelledError) as error:
            if isinstance(error, OSError) and future.status not in ("error", "cancelled"):
                # The worker was lost with the result, or the scheduler was lost: dask or our check reports
                # it.
                return None
            outcome = self._after(self._asked[future], error)
        del self._asked[future]
        return outcome

    def _after(self, job: Job, error: BaseException) -> Outcome | None:
        """Restart a study whose worker was lost, unless that happened too often."""
        # A lost connection does not count: it may come back, and the study is not the cause.
        self._lost[job.id] += getattr(error, "reason", "") != "scheduler-connection-lost"
        if self._lost[job.id] <= _LOST_WORKERS:
            self._waiting.append(job)
            return None
        count = self._lost[job.id]
        is_cancelled = isinstance(error, (asyncio.CancelledError, concurrent.futures.CancelledError))
        reason = f"its worker was lost {count} times" if is_cancelled else repr(error)
        return Outcome(job.id, "failed", reason, 0.0)

    def cancel(self) -> None:
        """Cancel the studies that the scheduler holds."""
        if self._asked:
            self._client.cancel(list(self._asked))


def run_on_worker(job: Job, lock: str) -> Outcome:
    """Process a study in its own process on a worker, with an equal share of the worker's cores."""
    distributed = _package("distributed", "dask.distributed")
    threads = job.threads or max(1, usable_cores() // distributed.get_worker().state.nthreads)
    child = Child(replace(job, threads=threads))
    looked = time.monotonic()
    try:
        while (outcome := child.outcome()) is None:
            time.sleep(0.05)
            if time.monotonic() - looked > _LOOK_FOR_BATCH:
                looked = time.monotonic()
                if not os.path.exists(lock):
                    return Outcome(job.id, "failed", "the batch was ended", 0.0)
        return outcome
    finally:
        child.end()
        child.wait()


@contextmanager
def dask_cluster(address: str) -> Iterator[Cluster]:
    """Connect to the scheduler of a dask.distributed cluster.

    Raises
    ------
    MissingPackageError
        Without dask.distributed.
    SettingsError
        If no scheduler answers.
    """
    distributed = _package("distributed", "dask.distributed")
    try:
        # With a time limit: Client waits forever if the other side accepts the connection but sends nothing.
        client = within(
            _CONNECTING + _ANSWER,
            lambda: distributed.Client(address, timeout=_CONNECTING, set_as_default=False),
        )
    except (OSError, ValueError) as error:
        found = str(error) or "no answer"
        raise SettingsError(f"dask {address}", found, "the address of a scheduler that answers") from error
    connection = ExitStack()
    connection.enter_context(quiet(client))
    connection.callback(client.close)
    try:
        yield Cluster(client)
    finally:
        briefly(connection.close)


@contextmanager
def slurm_cluster(options: str, jobs: int) -> Iterator[Cluster]:
    """Start workers as jobs of SLURM; the jobs end with the batch.

    Parameters
    ----------
    options : str
        Such as ``partition=long,memory=8GB,walltime=24:00:00,cores=2``; see `SLURM_NAMES`.
    jobs : int
        The number of jobs, each with one worker.

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
        # Jobs that end by their time limit, or because their node failed, are replaced.
        cluster.adapt(minimum_jobs=jobs, maximum_jobs=jobs)
        yield Cluster(client)


def slurm_options(options: str) -> dict[str, Any]:
    """Return the arguments of SLURMCluster: one study at a time in each job, dashboard on loopback only.

    Raises
    ------
    SettingsError
        For unknown options and invalid values.
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
    # One worker thread, so that one study has all cores and all memory of its job.
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
