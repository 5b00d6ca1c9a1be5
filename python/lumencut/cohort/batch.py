"""A cohort from its manifest to its tables: every study in a process of its own, none done twice."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Literal

from lumencut._checks import choice, integers, number
from lumencut._files import WRITABLE, checked_path
from lumencut._pickles import by_name
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

#: Called with how many studies ended, how many were to do, and how the last one ended.
Progress = Callable[[int, int, Outcome], object]
#: Does jobs as long as a file, the lock, is there, and yields how they ended; now and then None.
Engine = Callable[[Sequence[Job], Path], Iterator[Outcome | None]]

#: An interpreter with its libraries needs this much address space.
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
        How many studies of the manifest are done, failed, or not done yet.
    worked : int
        How many of them this batch did.
    notes : tuple of str
        What is odd about the manifest.
    left_out : int
        How many studies have no scan; they count as none of the others.
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
    """What each study may use.

    Attributes
    ----------
    threads : int
        How many threads compute.
    memory : int or None
        The most memory (bytes of address space).
    seconds : float or None
        The longest time.
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
    """Do every study of a manifest in a process of its own, and write the tables of the cohort.

    What is done already from the same files, by the same recipe and version, is not done again. However the
    batch is ended, only whole studies are there, and running it again goes on. docs/cohorts.md describes the
    manifest, the recipe and the tables.

    Parameters
    ----------
    manifest : path-like
        A table of studies (``.csv``, ``.tsv``), or a pattern of the names of volumes with ``{id}``.
    out : path-like
        The folder of the results; made where it is missing.
    recipe : path-like, optional
        A TOML file that says what is done with each study; without it the tree, one view of the look *focus*
        and measures.
    jobs : int, default 1
        How many studies are done at once.
    shard : pair of int, default (1, 1)
        Which part of the manifest is done, of how many, from 1: the tables hold what all parts have done.
    retry : {"failed", "all"}, optional
        What is done again although nothing has changed.
    threads : int, optional
        How many threads compute in each study; all cores divided by `jobs` where not given.
    memory : int, optional
        The most memory of each study (bytes of address space).
    time_limit : float, default 3600
        The longest time of each study (s); None for no limit.
    device : {"auto", "cpu", "gpu"}, default "auto"
        What computes pictures, as for :class:`lumencut.Renderer`.
    sources : dict of str, optional
        Beside a pattern of volumes that of their ``centerlines``, ``mask``, ``points`` or ``seeds``.
    dask : str, optional
        The address of a scheduler of dask.distributed, on whose workers studies are done: as many at once as
        they have threads, whatever `jobs` is. They must see the same files. Needs ``lumencut[cluster]``.
    slurm : str, optional
        Start `jobs` jobs of SLURM, each of which does one study at a time, with options such as
        ``"partition=long,memory=8GB,walltime=24:00:00,cores=2"``. Needs ``lumencut[cluster]``.
    parquet : bool, default False
        Write the tables as Parquet too. Needs ``lumencut[parquet]``.
    progress : callable, optional
        Called after each study with how many ended, how many were to do, and how this one ended.

    Returns
    -------
    BatchSummary
        How many studies are done, failed, and not done yet.

    Raises
    ------
    FormatError
        For a manifest or a recipe with mistakes, and a folder with results of another recipe or version.
    FileError
        For a folder that another batch writes into, a full disk, and a scheduler that stops answering.
    SettingsError
        For numbers out of range, `dask` and `slurm` at once, and a scheduler that does not answer.
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
        # Before hours of work, not behind them.
        check_parquet()
    with _engine(side, dask, slurm) as engine:
        summary = cohort.run(start, engine, wanted, progress)
    if parquet:
        cohort.write_parquet()
    return summary


@contextmanager
def _engine(jobs: int, dask: str | None, slurm: str | None) -> Iterator[Engine]:
    """What does the studies: this machine, or a cluster as long as it is needed."""
    if dask is not None and slurm is not None:
        raise SettingsError("dask and slurm", "both", "one of them, or none for this machine alone")
    if dask is None and slurm is None:
        yield lambda asked, _: side_by_side(asked, jobs)
        return
    from lumencut.cohort.cluster import dask_cluster, slurm_cluster

    with dask_cluster(dask) if dask is not None else slurm_cluster(slurm or "", jobs) as cluster:
        yield cluster.do


@dataclass(frozen=True)
class Wanted:
    """Which studies a batch does: a part of the manifest, and what is done again."""

    shard: Shard
    retry: Retry | None


@dataclass(frozen=True)
class Cohort:
    """The studies, what is done with each, and where the results lie."""

    manifest: Manifest
    recipe: CohortRecipe
    layout: Layout

    def job(self, study: Study, words: Sequence[str], limits: Limits) -> Job:
        """Return what the process of a study is started with."""
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
        """Do what is still to do, and write the tables, also where the batch is interrupted."""
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
        """Write the tables of what is there, and do nothing else."""
        self._make()
        settle_recipe(self.layout, self.recipe, None)
        return self._tables(planned(self.layout, self.manifest, self.recipe))

    def write_parquet(self) -> None:
        """Write the tables that are there as Parquet too."""
        for name in ("studies", *OF_STUDIES):
            further = further_names(self.manifest) if name == "studies" else ()
            write_parquet(self.layout.out / f"{name}.csv", frozenset(further))

    def open_studies(self) -> list[Study]:
        """Return the studies that are not done with what their files and the recipe are now."""
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
        """Remove what a killed batch left of these studies, which nobody else does."""
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
        """Do studies, and record of each that could not do so itself why it failed."""
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
            mend = "free some, and run the batch again: it goes on where it was"
            raise FileError(str(self.layout.out), "no room left on the disk", "room for results", mend)
        return ended

    def _explained(self, one: Planned, outcome: Outcome) -> Outcome:
        """How a study ended, with the reason that its own process recorded."""
        if outcome.state != "failed" or outcome.reason:
            return outcome
        record = read_record(self.layout.failure(one.study))
        return outcome if record is None else replace(outcome, reason=record.reason)

    def _tables(self, plans: Sequence[Planned]) -> BatchSummary:
        """Write the tables of all that is there now, of other shards too."""
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
    """How many threads each of some studies gets on this machine."""
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    return max(1, cores // jobs)


def _limits(threads: int | None, usual: int, memory: int | None, seconds: float | None) -> Limits:
    """What each study may use, checked; `usual` threads where none are given."""
    used = usual if threads is None else integers(SettingsError, "threads", [threads], 1, 1024, 1)[0]
    if memory is not None and memory < _LEAST_MEMORY:
        raise SettingsError("memory", f"{memory} bytes", f"at least {_LEAST_MEMORY} bytes")
    if seconds is not None and not 0 < number(SettingsError, "time_limit", seconds) < float("inf"):
        raise SettingsError("time_limit", f"{seconds:g} s", "more than 0 s, or no limit")
    return Limits(used, memory, seconds)
