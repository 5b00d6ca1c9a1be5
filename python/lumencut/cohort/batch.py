"""Processes a cohort, from the manifest to the tables: each study once, in its own process."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Literal

from lumencut.base.checks import choice, integers, number
from lumencut.base.cores import usable_cores
from lumencut.base.paths import WRITABLE, checked_path
from lumencut.base.pickles import by_name
from lumencut.cohort.child import Outcome
from lumencut.cohort.engine import side_by_side
from lumencut.cohort.job import Job
from lumencut.cohort.layout import Layout
from lumencut.cohort.lock import Lock, Shard, held, one_at_a_time
from lumencut.cohort.manifest import Manifest, Study, read_manifest
from lumencut.cohort.one import record_failure
from lumencut.cohort.parquet import check_parquet, write_parquet
from lumencut.cohort.plan import Planned, Retry, known_record, planned, settle_recipe, to_do
from lumencut.cohort.recipe import CohortRecipe, read_cohort_recipe
from lumencut.cohort.record import read_record
from lumencut.cohort.tables import OF_STUDIES, further_names, write_tables
from lumencut.errors import FileError, SettingsError

#: Function that is called with the number of ended studies, the total, and how the last study ended.
Progress = Callable[[int, int, Outcome], object]
#: Runs jobs as long as the lock file exists; yields how each ended, and None at intervals.
Engine = Callable[[Sequence[Job], Path], Iterator[Outcome | None]]

#: The address space that Python with its libraries needs (bytes).
_LEAST_MEMORY = 256 << 20


@by_name
@dataclass(frozen=True)
class BatchSummary:
    """How a batch ended.

    Attributes
    ----------
    out : Path
        The folder of the results.
    done, failed, skipped : int
        The number of studies of the manifest that succeeded, failed, or are not processed yet.
    worked : int
        How many of them this batch processed.
    notes : tuple of str
        Notes on the manifest.
    left_out : int
        The number of studies without a scan; they are not in the other counts.
    """

    out: Path
    done: int
    failed: int
    skipped: int
    worked: int
    notes: tuple[str, ...] = ()
    left_out: int = 0


@dataclass(frozen=True)
class Limits:
    """The limits of each study.

    Attributes
    ----------
    threads : int
        The number of threads.
    memory : int or None
        The memory limit (bytes of address space).
    seconds : float or None
        The time limit.
    """

    threads: int
    memory: int | None = None
    seconds: float | None = 3600.0


def batch(
    manifest: str | os.PathLike[str],
    out: str | os.PathLike[str],
    *,
    recipe: str | os.PathLike[str] | None = None,
    jobs: int = 1,
    shard: tuple[int, int] = (1, 1),
    retry: Retry | None = None,
    threads: int | None = None,
    memory: int | None = None,
    time_limit: float | None = 3600.0,
    device: Literal["auto", "cpu", "gpu"] = "auto",
    sources: dict[str, str] | None = None,
    dask: str | None = None,
    slurm: str | None = None,
    parquet: bool = False,
    progress: Progress | None = None,
) -> BatchSummary:
    """Process every study of a manifest in its own process, and write the tables of the cohort.

    Studies with results from the same files, recipe and version are skipped. However the batch ends, the
    folder contains only complete studies; run the batch again to continue it. docs/cohorts.md describes the
    manifest, the recipe and the tables.

    Parameters
    ----------
    manifest : path-like
        A table of studies (``.csv``, ``.tsv``), or a pattern of the names of volumes with ``{id}``.
    out : path-like
        The folder of the results; created if missing.
    recipe : path-like, optional
        A TOML file that defines what to do with each study; by default the tree, one view of the look *focus*
        and measures.
    jobs : int, default 1
        How many studies to process at once.
    shard : pair of int, default (1, 1)
        The part of the manifest to process, from 1, and the number of parts; tables cover all parts.
    retry : {"failed", "all"}, optional
        The studies to process again although nothing has changed.
    threads : int, optional
        Threads per study; by default all cores divided by `jobs`.
    memory : int, optional
        Memory limit per study (bytes of address space).
    time_limit : float, default 3600
        Time limit per study (s); None for no limit.
    device : {"auto", "cpu", "gpu"}, default "auto"
        The device that renders, as for :class:`lumencut.Renderer`.
    sources : dict of str, optional
        With a pattern of volumes: that of their ``centerlines``, ``mask``, ``points`` or ``seeds``.
    dask : str, optional
        The address of a dask.distributed scheduler whose workers process the studies: as many at once as they
        have threads, regardless of `jobs`. They must see the same files. Needs ``lumencut[cluster]``.
    slurm : str, optional
        Start `jobs` jobs of SLURM, each of which processes one study at a time, with options such as
        ``"partition=long,memory=8GB,walltime=24:00:00,cores=2"``. Needs ``lumencut[cluster]``.
    parquet : bool, default False
        Write the tables as Parquet too. Needs ``lumencut[parquet]``.
    progress : callable, optional
        Called after each study with the number of ended studies, the total, and how this one ended.

    Returns
    -------
    BatchSummary
        The number of studies that succeeded, failed, and are not processed yet.

    Raises
    ------
    FormatError
        For a manifest or a recipe with mistakes, and a folder with results of another recipe or version.
    FileError
        If another batch writes into the folder, the disk is full, or the scheduler stops answering.
    SettingsError
        For numbers out of range, `dask` together with `slurm`, and a scheduler that does not answer.
    MissingPackageError
        Without the packages of a cluster, or of Parquet.
    """
    found = read_manifest(os.fspath(manifest), **(sources or {}))
    cohort = Cohort(found, read_cohort_recipe(recipe), Layout(checked_path(out, WRITABLE).absolute()))
    if retry is not None:
        choice(SettingsError, "retry", retry, ("failed", "all"))
    choice(SettingsError, "device", device, ("auto", "cpu", "gpu"))
    (side,) = integers(SettingsError, "jobs", [jobs], 1, 1024, 1)
    words = [f"--device={device}", *(f"--{name}={path}" for name, path in (sources or {}).items())]
    if recipe is not None:
        words.append(f"--recipe={Path(recipe).absolute()}")
    is_cluster = dask is not None or slurm is not None
    limits = _limits(threads, 0 if is_cluster else _fair_threads(side), memory, time_limit)
    start, wanted = partial(cohort.job, words=words, limits=limits), Wanted(checked_shard(shard), retry)
    if parquet:
        # Checked now, because writing comes after hours of work.
        check_parquet()
    with _engine(side, dask, slurm) as engine:
        summary = cohort.run(start, engine, wanted, progress)
    if parquet:
        cohort.write_parquet()
    return summary


@contextmanager
def _engine(jobs: int, dask: str | None, slurm: str | None) -> Iterator[Engine]:
    """Return the engine for the studies: this machine, or a cluster that ends with the context."""
    if dask is not None and slurm is not None:
        raise SettingsError("dask and slurm", "both", "one of them, or neither for this machine")
    if dask is None and slurm is None:
        yield lambda asked, _: side_by_side(asked, jobs)
        return
    from lumencut.cohort.cluster import dask_cluster, slurm_cluster

    with dask_cluster(dask) if dask is not None else slurm_cluster(slurm or "", jobs) as cluster:
        yield cluster.do


@dataclass(frozen=True)
class Wanted:
    """The studies of a batch: a part of the manifest, and which to process again."""

    shard: Shard
    retry: Retry | None


@dataclass(frozen=True)
class Cohort:
    """The studies, the recipe, and the folder of the results."""

    manifest: Manifest
    recipe: CohortRecipe
    layout: Layout

    def job(self, study: Study, words: Sequence[str], limits: Limits) -> Job:
        """Return the job that runs one study in a process."""
        manifest = str(Path(self.manifest.path).absolute())
        given = ["batch", manifest, f"--output={self.layout.out}", f"--one={study.id}", *words]
        if limits.memory is not None:
            given.append(f"--memory={limits.memory}")
        return Job(study.id, tuple(given), self.layout.log(study), limits.threads, limits.seconds)

    def run(
        self,
        job_of: Callable[[Study], Job],
        engine: Engine,
        wanted: Wanted,
        progress: Progress | None = None,
    ) -> BatchSummary:
        """Process the remaining studies; write the tables even if the batch is interrupted."""
        self._make()
        with held(self.layout, wanted.shard) as lock:
            settle_recipe(self.layout, self.recipe, wanted.retry)
            plans = planned(self.layout, self.manifest, self.recipe)
            tasks = to_do(plans, wanted.shard, wanted.retry)
            self._sweep(one.study for place, one in enumerate(plans) if wanted.shard.has(place))
            try:
                worked = self._work(tasks, job_of, engine, lock, progress)
            finally:
                summary = self._tables(plans)
        return replace(summary, worked=worked, notes=self.manifest.notes)

    def gather(self) -> BatchSummary:
        """Write the tables of the existing results, and do nothing else."""
        self._make()
        settle_recipe(self.layout, self.recipe, None)
        return self._tables(planned(self.layout, self.manifest, self.recipe))

    def write_parquet(self) -> None:
        """Also write the existing tables as Parquet."""
        for name in ("studies", *OF_STUDIES):
            further = further_names(self.manifest) if name == "studies" else ()
            write_parquet(self.layout.out / f"{name}.csv", frozenset(further))

    def open_studies(self) -> list[Study]:
        """Return the studies without results from their present files and the present recipe."""
        self._make()
        settle_recipe(self.layout, self.recipe, None)
        plans = planned(self.layout, self.manifest, self.recipe)
        return [one.study for one in to_do(plans, Shard(1, 1), "failed")]

    def _make(self) -> None:
        try:
            self.layout.make()
        except OSError as error:
            found = error.strerror or str(error)
            raise FileError(str(self.layout.out), found, "a folder to write into") from error

    def _sweep(self, studies: Iterable[Study]) -> None:
        """Remove incomplete results of these studies, left by a batch that was killed."""
        labels = {study.label for study in studies}
        for path in self.layout.unfinished.iterdir():
            if path.name.partition(".")[0] in labels:
                shutil.rmtree(path, ignore_errors=True)

    def _work(
        self,
        tasks: Sequence[Planned],
        job_of: Callable[[Study], Job],
        engine: Engine,
        lock: Lock,
        progress: Progress | None,
    ) -> int:
        """Process studies, and record why a study failed if its process could not."""
        by_id = {one.study.id: one for one in tasks}
        ended, has_room = 0, True
        for outcome in engine([job_of(one.study) for one in tasks], lock.path):
            lock.renew()
            if outcome is None:
                continue
            has_room = has_room and outcome.state != "no room"
            one = by_id[outcome.id]
            if outcome.state == "failed" and outcome.reason:
                record_failure(self.layout, one.study, one.origin, outcome.reason, outcome.seconds)
            ended += 1
            if progress is not None:
                progress(ended, len(tasks), self._explained(one, outcome))
        if not has_room:
            mend = "free space, and run the batch again: it continues"
            raise FileError(str(self.layout.out), "no room left on the disk", "room for results", mend)
        return ended

    def _explained(self, one: Planned, outcome: Outcome) -> Outcome:
        """Return how a study ended, with the reason that the process of the study recorded."""
        if outcome.state != "failed" or outcome.reason:
            return outcome
        record = read_record(self.layout.failure(one.study))
        return outcome if record is None else replace(outcome, reason=record.reason)

    def _tables(self, plans: Sequence[Planned]) -> BatchSummary:
        """Write the tables of all existing results, including those of other shards."""
        with one_at_a_time(self.layout):
            records = [known_record(self.layout, one.study, one.origin) for one in plans]
            write_tables(self.layout, self.manifest, records)
        states = [None if record is None else record.state for record in records]
        left_out = sum(bool(one.study.left_out) for one in plans)
        skipped = states.count(None) - left_out
        return BatchSummary(
            self.layout.out, states.count("done"), states.count("failed"), skipped, 0, left_out=left_out
        )


def checked_shard(shard: tuple[int, int]) -> Shard:
    """Return a part of the manifest, checked."""
    number, count = integers(SettingsError, "shard", list(shard), 1, 1_000_000, 2)
    if number > count:
        raise SettingsError("shard", f"{number} of {count}", f"a number from 1 to {count}")
    return Shard(number, count)


def _fair_threads(jobs: int) -> int:
    """Return the number of threads per study, so that all jobs share the cores of this machine."""
    return max(1, usable_cores() // jobs)


def _limits(threads: int | None, usual: int, memory: int | None, seconds: float | None) -> Limits:
    """Return the checked limits of each study; by default it has `usual` threads."""
    used = usual if threads is None else integers(SettingsError, "threads", [threads], 1, 1024, 1)[0]
    if memory is not None and memory < _LEAST_MEMORY:
        raise SettingsError("memory", f"{memory} bytes", f"at least {_LEAST_MEMORY} bytes")
    if seconds is not None and not 0 < number(SettingsError, "time_limit", seconds) < float("inf"):
        raise SettingsError("time_limit", f"{seconds:g} s", "more than 0 s, or no limit")
    return Limits(used, memory, seconds)
