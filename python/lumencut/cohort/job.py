"""How to start the process of a study, and how to start Python without modules from untrusted folders."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path

#: Exit codes of the process of a study: complete, failed with a record, no room on the disk.
DONE, SOME_FAILED, NO_ROOM = 0, 3, 4


@dataclass(frozen=True)
class Job:
    """What is needed to start the process of a study; it can be sent to another machine.

    Attributes
    ----------
    id : str
        The study.
    words : tuple of str
        The arguments of ``lumencut``.
    log : Path
        Receives its output.
    threads : int
        The number of threads; on a cluster 0 means a fair share of the cores of the worker.
    seconds : float or None
        Its time limit; it is killed afterwards.
    """

    id: str
    words: tuple[str, ...]
    log: Path
    threads: int
    seconds: float | None


def launch_words(code: str, *words: str) -> list[str]:
    """Return the command that runs Python code with these arguments.

    Modules are loaded from the folders of this process, never from the current folder: it may be untrusted.
    """
    here = [entry for entry in sys.path if isinstance(entry, str)]
    start = f"import sys; n = int(sys.argv[1]) + 2; sys.path[:] = sys.argv[2:n]; del sys.argv[1:n]; {code}"
    return [sys.executable, "-c", start, str(len(here)), *here, *words]
