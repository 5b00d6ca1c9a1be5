"""Processes one study in this process: sets limits, fills a folder, renames it when complete."""

from __future__ import annotations

import errno
import logging
import os
import secrets
import shutil
import sys
import time
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from lumencut.cohort.job import DONE, NO_ROOM, SOME_FAILED
from lumencut.cohort.layout import Layout, flush
from lumencut.cohort.manifest import Study
from lumencut.cohort.recipe import CohortRecipe
from lumencut.cohort.record import Origin, Record, origin_of
from lumencut.cohort.study import Device, do_study
from lumencut.errors import FileError, LumencutError

_MOST_WARNINGS = 20


def limit_memory(most: int | None) -> None:
    """Limit the memory of this process; if the machine runs out of memory, this process is killed first."""
    # Only Linux has this file.
    with suppress(OSError):
        Path("/proc/self/oom_score_adj").write_text("1000", "ascii")
    if most is not None:
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (most, most))


def do_one(study: Study, recipe: CohortRecipe, layout: Layout, device: Device) -> int:
    """Process one study: its complete results appear at once, or a record of the failure.

    Returns
    -------
    int
        The exit code of the process: `DONE`, `SOME_FAILED` or `NO_ROOM`.
    """
    layout.make()
    origin = origin_of(study, recipe.digest)
    start = time.monotonic()
    work = layout.unfinished / f"{study.label}.{secrets.token_hex(8)}"
    try:
        with _heard() as warned:
            work.mkdir()
            try:
                numbers = do_study(study, recipe, work, device)
                _check_unchanged(study, origin)
            except Exception as error:
                if _is_disk_full(error):
                    raise
                seconds = time.monotonic() - start
                record_failure(layout, study, origin, _reason(error), seconds, tuple(warned))
                return SOME_FAILED
            seconds = round(time.monotonic() - start, 3)
            made = Record(study.id, "done", "", seconds, origin, tuple(warned), numbers)
            made.write(work / layout.record(study).name)
            put_in_place(work, layout, study)
            return DONE
    except Exception as error:
        if not _is_disk_full(error):
            raise
        print(f"lumencut: error: {layout.out}: no room left on the disk", file=sys.stderr)
        return NO_ROOM
    finally:
        shutil.rmtree(work, ignore_errors=True)


def _check_unchanged(study: Study, origin: Origin) -> None:
    """Reject results if the input files changed while the study was processed."""
    if origin_of(study, origin.recipe) != origin:
        expected = "files that do not change during the study"
        raise FileError(str(study.volume), "changed files", expected, "run the batch again")


def _is_disk_full(error: BaseException | None) -> bool:
    """Return whether a file error was caused by a full disk or by the user's quota."""
    full = (errno.ENOSPC, errno.EDQUOT)
    while error is not None:
        if isinstance(error, OSError) and error.errno in full:
            return True
        error = error.__cause__
    return False


def _reason(error: Exception) -> str:
    """Return the sentence that says why a study failed."""
    if isinstance(error, MemoryError) or (isinstance(error, OSError) and error.errno == errno.ENOMEM):
        return "not enough memory"
    if isinstance(error, (LumencutError, OSError)):
        return str(error)
    logging.getLogger("lumencut").exception("unexpected")
    return f"unexpected {type(error).__name__}: {error}"


def put_in_place(work: Path, layout: Layout, study: Study) -> None:
    """Move a complete folder into the results, replacing former ones, in one step."""
    for path in work.iterdir():
        flush(path)
    flush(work)
    place = layout.folder(study)
    place.parent.mkdir(parents=True, exist_ok=True)
    former = work.with_name(f"{work.name}.former")
    if place.exists():
        os.rename(place, former)
    os.rename(work, place)
    flush(place.parent)
    layout.failure(study).unlink(missing_ok=True)
    shutil.rmtree(former, ignore_errors=True)


def record_failure(
    layout: Layout, study: Study, origin: Origin, reason: str, seconds: float, warned: tuple[str, ...] = ()
) -> None:
    """Record why a study failed, and remove its former results, which are outdated."""
    words = "".join(letter if letter.isprintable() else " " for letter in " ".join(reason.split()))
    Record(study.id, "failed", words, round(seconds, 3), origin, warned).write(layout.failure(study))
    place = layout.folder(study)
    if place.exists():
        former = layout.unfinished / f"{study.label}.{secrets.token_hex(8)}.former"
        os.rename(place, former)
        shutil.rmtree(former, ignore_errors=True)


@contextmanager
def _heard() -> Iterator[list[str]]:
    """Collect warnings for the record; they are shown as well."""
    warned: list[str] = []

    class _Ear(logging.Handler):
        def emit(self, record: logging.LogRecord) -> None:
            _keep(warned, record.getMessage())

    log, ear = logging.getLogger("lumencut"), _Ear(logging.WARNING)
    log.addHandler(ear)
    shown = warnings.showwarning

    def show(message: Warning | str, *where: object) -> None:
        _keep(warned, str(message))
        shown(message, *where)  # type: ignore[arg-type]

    warnings.showwarning = show  # type: ignore[assignment]
    try:
        yield warned
    finally:
        log.removeHandler(ear)
        warnings.showwarning = shown


def _keep(warned: list[str], text: str) -> None:
    words = " ".join(text.split())
    if words not in warned and len(warned) < _MOST_WARNINGS:
        warned.append(words)
