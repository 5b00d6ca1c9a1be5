"""A process with all modules loaded that forks itself for each study, so that a study starts at once.

Loading takes most of a second, a fork a few milliseconds. The process computes nothing and starts no threads,
so it is safe to fork. It ends with the batch, together with its children. The forkserver of multiprocessing
would run the caller's script again in each child, and modules of the current folder, which may be untrusted.
"""

from __future__ import annotations

import gc
import importlib
import json
import os
import select
import sys
from pathlib import Path
from typing import Any, NoReturn

from lumencut.cli import main
from lumencut.cohort.parent import PARENT, end_with_parent

#: Interval between checks of the children (s).
_LOOK = 0.01
#: Modules imported before the first fork; otherwise each study would have to import them.
_LOADED = (
    *("lumencut.cohort.one", "lumencut.pictures.recipe", "pydicom", "tqdm", "numpy.ma"),
    *("PIL.Image", "PIL.ImageDraw", "PIL.ImageFont", "PIL.WebPImagePlugin"),
)


def serve() -> NoReturn:
    """Fork a process for each line of the standard input, and report on the standard output which ended."""
    end_with_parent()
    for name in _LOADED:
        importlib.import_module(name)
    # So that Pillow loads its file formats once, not in every study.
    sys.modules["PIL.Image"].init()
    # Loaded objects are excluded from garbage collection, so that forked processes share their memory.
    gc.freeze()
    numbers: dict[int, int] = {}
    asked = b""
    while True:
        if select.select([0], [], [], _LOOK)[0]:
            read = os.read(0, 1 << 16)
            if not read:
                os._exit(0)
            *lines, asked = (asked + read).split(b"\n")
            for line in lines:
                order = json.loads(line)
                pid = os.fork()
                if pid == 0:
                    _become(order)
                numbers[pid] = order["number"]
                os.write(1, f"born {order['number']} {pid}\n".encode())
        _report_ended(numbers)


def _report_ended(numbers: dict[int, int]) -> None:
    while numbers:
        pid, status = os.waitpid(-1, os.WNOHANG)
        if pid == 0:
            return
        os.write(1, f"ended {numbers.pop(pid)} {os.waitstatus_to_exitcode(status)}\n".encode())


def _become(order: dict[str, Any]) -> NoReturn:
    """Continue as the process of a study, as if started by the command line of the study."""
    code = 1
    try:
        os.environ[PARENT] = str(os.getppid())
        os.environ["RAYON_NUM_THREADS"] = str(order["threads"])
        os.setsid()
        log = os.open(Path(order["log"]), os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o666)
        for number in (1, 2):
            os.dup2(log, number)
        os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
        main(args=list(order["words"]), prog_name="lumencut")
    except SystemExit as end:
        code = end.code if isinstance(end.code, int) else 0 if end.code is None else 1
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(code)
