"""Ends a process when its parent process ends, for whatever reason."""

from __future__ import annotations

import ctypes
import os
import signal
import sys

PARENT = "LUMENCUT_BATCH_PARENT"
_PR_SET_PDEATHSIG = 1


def end_with_parent() -> None:
    """Let the system end this process together with the process `PARENT`; without `PARENT` do nothing."""
    parent = os.environ.pop(PARENT, None)
    if parent is None or not sys.platform.startswith("linux"):
        return
    ctypes.CDLL(None, use_errno=True).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
    if os.getppid() != int(parent):
        os._exit(1)
