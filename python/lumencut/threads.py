"""How many threads compute on the CPU, in all of this process."""

from __future__ import annotations

from lumencut import _lumencut
from lumencut._checks import integers
from lumencut.errors import SettingsError

#: More than any processor runs at once.
_MOST = 1024


def set_threads(count: int | None) -> None:
    """Let ``count`` threads compute from now on, in all of this process; results do not depend on it.

    It holds for renderers that are already there too, and bounds the processes that decode DICOM slices. A
    GPU is not concerned. Without a call the environment variable ``RAYON_NUM_THREADS`` counts, else the
    number of cores.

    Parameters
    ----------
    count : int or None
        How many threads, 1 to 1024; with None what holds without a call.

    Raises
    ------
    SettingsError
        For another count.
    """
    if count is None:
        _lumencut.set_threads(0)
        return
    if isinstance(count, bool):
        raise SettingsError("threads", repr(count), f"a whole number from 1 to {_MOST}, or None")
    (checked,) = integers(SettingsError, "threads", [count], 1, _MOST, 1)
    _lumencut.set_threads(checked)


def get_threads() -> int:
    """Return how many threads compute on the CPU; see :func:`set_threads`."""
    return _lumencut.threads()
