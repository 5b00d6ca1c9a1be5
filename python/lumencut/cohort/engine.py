"""Studies side by side on this machine, each in a process of its own."""

from __future__ import annotations

import sys
import time
from collections import Counter, deque
from collections.abc import Iterator, Sequence
from contextlib import suppress

from lumencut.cohort.child import Child, Outcome
from lumencut.cohort.job import Job
from lumencut.cohort.nursery import Nursery, NurseryError

#: How long to sleep between two looks at the processes (s), and after how many seconds to say that all go on.
_LOOK, _TICK = 0.02, 1.0
#: A study whose process was lost with the one that forked it is begun again so many times.
_LOST = 3


def side_by_side(jobs: Sequence[Job], count: int) -> Iterator[Outcome | None]:
    """Do jobs, `count` of them at once, and yield how each ended as soon as it has.

    Where none has ended for a second None is yielded, so that the caller can do what time asks for. When the
    caller leaves, by Ctrl-C or any other way, all processes are ended. Where the disk is full none is begun.
    """
    if not jobs:
        return
    waiting, working = deque(jobs), list[Child]()
    lost: Counter[str] = Counter()
    # A fork is safe on Linux alone: the libraries of other systems may have threads.
    is_forked = sys.platform.startswith("linux")
    while waiting:
        nursery = Nursery() if is_forked else None
        try:
            yield from _with(nursery, waiting, working, count)
            return
        except NurseryError:
            again = [child.job for child in working]
            working.clear()
            # Where it cannot even begin, each study has a process that is started anew.
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
    """Do what waits, as long as the process that forks them works."""
    start = None if nursery is None else nursery.start
    has_room, told = True, time.monotonic()
    while working or (waiting and has_room):
        while waiting and has_room and len(working) < count:
            working.append(Child(waiting[0], start))
            waiting.popleft()
        for child in list(working):
            outcome = child.outcome()
            if outcome is not None:
                working.remove(child)
                has_room = has_room and outcome.state != "no room"
                told = time.monotonic()
                yield outcome
        if time.monotonic() - told > _TICK:
            told = time.monotonic()
            yield None
        time.sleep(_LOOK)
    if not has_room:
        waiting.clear()
