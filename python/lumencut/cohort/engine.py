"""Studies side by side on this machine, each in a process of its own."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Iterator, Sequence

from lumencut.cohort.child import Child, Job, Outcome

#: How long to sleep between two looks at the processes (s), and after how many seconds to say that all go on.
_LOOK, _TICK = 0.02, 1.0


def side_by_side(jobs: Sequence[Job], count: int) -> Iterator[Outcome | None]:
    """Do jobs, `count` of them at once, and yield how each ended as soon as it has.

    Where none has ended for a second None is yielded, so that the caller can do what time asks for. When the
    caller leaves, by Ctrl-C or any other way, all processes are ended. Where the disk is full none is begun.
    """
    waiting, working = deque(jobs), list[Child]()
    has_room = True
    told = time.monotonic()
    try:
        while working or (waiting and has_room):
            while waiting and has_room and len(working) < count:
                working.append(Child(waiting.popleft()))
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
    finally:
        for child in working:
            child.end()
        for child in working:
            child.wait()
