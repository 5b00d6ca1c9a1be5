"""A process ends when the one that started it ends, however that ends."""

from __future__ import annotations

import ctypes
import os
import signal
import sys

#: Says which process has started this one.
PARENT = "LUMENCUT_BATCH_PARENT"
_PR_SET_PDEATHSIG = 1


def end_with_parent() -> None:
    """See that the system ends this process with the one that `PARENT` names; without it nothing is done."""
    parent = os.environ.pop(PARENT, None)
    if parent is None or not sys.platform.startswith("linux"):
        return
    ctypes.CDLL(None, use_errno=True).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
    # It may have ended before.
    if os.getppid() != int(parent):
        os._exit(1)
