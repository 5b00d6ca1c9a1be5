"""Number of CPU threads of this process."""

from __future__ import annotations

from lumencut import _lumencut
from lumencut.base.checks import integers
from lumencut.errors import SettingsError

#: More than any processor runs at once.
_MOST = 1024


def set_threads(count: int | None) -> None:
    """Set the number of CPU threads of this process; results do not depend on it.

    It also applies to existing renderers, and limits the processes that decode DICOM slices; a GPU is not
    affected. The default is the environment variable ``RAYON_NUM_THREADS``, or the number of cores.

    Parameters
    ----------
    count : int or None
        Number of threads, 1 to 1024; None for the default.

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
    """Return the number of CPU threads; see :func:`set_threads`."""
    return _lumencut.threads()
