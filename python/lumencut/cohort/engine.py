"""Runs studies in parallel on this machine, each in its own process."""

from __future__ import annotations

import sys
import time
from collections import Counter, deque
from collections.abc import Iterator, Sequence
from contextlib import suppress

from lumencut.cohort.child import Child, Outcome
from lumencut.cohort.job import Job
from lumencut.cohort.nursery import Nursery, NurseryError

#: Intervals between checks of the processes, and between calls of the caller if no study ends (s).
_LOOK, _TICK = 0.02, 1.0
#: How often a study is restarted if its process was lost together with the process that forked it.
_LOST = 3


def side_by_side(jobs: Sequence[Job], count: int) -> Iterator[Outcome | None]:
    """Run jobs, at most `count` at once, and yield how each ended.

    If none ends for a second, None is yielded, so that the caller can do periodic work. When the caller
    stops iterating, by Ctrl-C or for another reason, all processes are ended. On a full disk no job starts.
    """
    if not jobs:
        return
    waiting, working = deque(jobs), list[Child]()
    lost: Counter[str] = Counter()
    # Forking is safe only on Linux: on other systems, libraries may already have started threads.
    is_forked = sys.platform.startswith("linux")
    while waiting:
        nursery = Nursery() if is_forked else None
        try:
            yield from _with(nursery, waiting, working, count)
            return
        except NurseryError:
            again = [child.job for child in working]
            working.clear()
            # If the forking process cannot start, each study gets a new Python process.
            is_forked = bool(again)
            lost.update(job.id for job in again)
            waiting.extendleft(job for job in again if lost[job.id] <= _LOST)
            for job in again:
                if lost[job.id] > _LOST:
                    yield Outcome(job.id, "failed", f"its process was lost {_LOST + 1} times", 0.0)
        finally:
            for child in working:
                child.end()
            with suppress(NurseryError):
                for child in working:
                    child.wait()
            if nursery is not None:
                nursery.close()


def _with(
    nursery: Nursery | None, waiting: deque[Job], working: list[Child], count: int
) -> Iterator[Outcome | None]:
    """Run the waiting jobs as long as the forking process works."""
    start = None if nursery is None else nursery.start
    has_room, reported = True, time.monotonic()
    while working or (waiting and has_room):
        while waiting and has_room and len(working) < count:
            working.append(Child(waiting[0], start))
            waiting.popleft()
        for child in list(working):
            outcome = child.outcome()
            if outcome is not None:
                working.remove(child)
                has_room = has_room and outcome.state != "no room"
                reported = time.monotonic()
                yield outcome
        if time.monotonic() - reported > _TICK:
            reported = time.monotonic()
            yield None
        time.sleep(_LOOK)
    if not has_room:
        waiting.clear()
