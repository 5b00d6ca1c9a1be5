"""What the process of a study is started with, and how Python starts without looking into strange folders."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path

#: The exit codes of a process that does one study: whole, failed with a record of it, no room on the disk.
#: A batch of which some studies failed ends with the second one too.
DONE, SOME_FAILED, NO_ROOM = 0, 3, 4


@dataclass(frozen=True)
class Job:
    """What the process of a study is started with; it can be sent to another machine.

    Attributes
    ----------
    id : str
        The study.
    words : tuple of str
        What stands behind ``lumencut``.
    log : Path
        Where it writes what it prints.
    threads : int
        How many threads compute; on a cluster 0 stands for a fair part of the cores of the worker.
    seconds : float or None
        It is killed when it takes longer.
    """

    id: str
    words: tuple[str, ...]
    log: Path
    threads: int
    seconds: float | None


def launch_words(code: str, *words: str) -> list[str]:
    """Return the command that runs Python code with these arguments.

    Modules come from where ours came from: never from the current folder, which may be a stranger's.
    """
    here = [entry for entry in sys.path if isinstance(entry, str)]
    start = f"import sys; n = int(sys.argv[1]) + 2; sys.path[:] = sys.argv[2:n]; del sys.argv[1:n]; {code}"
    return [sys.executable, "-c", start, str(len(here)), *here, *words]
