"""Available memory, and the rejection of volumes that need more, before any of it is allocated."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from lumencut.errors import FormatError

PYRAMID_MEMORY = 1_000_000_000
"""Most bytes of voxels of an image in chunks, if no limit is given."""
_UNKNOWN = 1 << 48
"""The memory of a system that does not report it."""
_SMALL = 16 << 20
"""Smaller amounts are not checked: the check takes longer than the allocation."""
_CONTROL_GROUPS = Path("/sys/fs/cgroup")
_MEND = "crop or resample it, free memory, or raise the memory limit if there is one"


def require_memory(subject: object, needed: int) -> None:
    """Reject what needs more memory than is available.

    Parameters
    ----------
    subject : object
        Names the file in the error.
    needed : int
        Bytes to allocate at once.

    Raises
    ------
    FormatError
        If less is available.
    """
    if needed <= _SMALL:
        return
    available = available_memory()
    if needed > available:
        found = f"voxels that need {in_words(needed)} of memory"
        raise FormatError(str(subject), found, f"at most the available {in_words(available)}", _MEND)


def in_words(count: int) -> str:
    """Return a number of bytes as GB or MB, such as ``6.2 GB``."""
    return f"{count / 1e9:.4g} GB" if count >= 1e9 else f"{count / 1e6:.4g} MB"


def available_memory() -> int:
    """Return the bytes that this process can still allocate, by machine, container and its own limit."""
    return max(min((*_of_machine(), *_of_control_groups(), *_of_process()), default=_UNKNOWN), 0)


def _of_machine() -> Iterator[int]:
    if sys.platform == "win32":
        yield _of_windows()
        return
    with suppress(OSError, ValueError, IndexError):
        for line in Path("/proc/meminfo").read_text("ascii").splitlines():
            if line.startswith("MemAvailable:"):
                yield int(line.split()[1]) << 10
                return
    # Other systems report the total memory, not the free memory.
    with suppress(AttributeError, OSError, ValueError):
        yield os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")


def _of_windows() -> int:
    """The memory that is free, as Windows says it: the third number of its structure, after two lengths."""
    import ctypes

    status = (ctypes.c_uint64 * 8)()
    ctypes.c_uint32.from_buffer(status).value = ctypes.sizeof(status)
    windows = ctypes.windll.kernel32  # type: ignore[attr-defined,unused-ignore]
    return int(status[2]) if windows.GlobalMemoryStatusEx(ctypes.byref(status)) else _UNKNOWN


def _of_control_groups() -> Iterator[int]:
    """The remaining memory of the control groups of this process, version 1 or 2."""
    with suppress(OSError, ValueError):
        for line in Path("/proc/self/cgroup").read_text("utf-8").splitlines():
            _, controllers, group = line.split(":", 2)
            if controllers == "":
                yield from _left(_CONTROL_GROUPS, group, "memory.max", "memory.current")
            elif "memory" in controllers.split(","):
                names = ("memory.limit_in_bytes", "memory.usage_in_bytes")
                yield from _left(_CONTROL_GROUPS / "memory", group, *names)


def _left(root: Path, group: str, limit: str, used: str) -> Iterator[int]:
    """The remaining memory of a group and its parents; reclaimable file cache counts as free."""
    place = root / group.strip("/")
    for folder in (place, *place.parents):
        with suppress(OSError, ValueError):
            # A group without a limit says "max", which is no number.
            most = int((folder / limit).read_text("ascii"))
            held = int((folder / used).read_text("ascii"))
            stated = dict(line.split() for line in (folder / "memory.stat").read_text("ascii").splitlines())
            dropped = stated.get("inactive_file", stated.get("total_inactive_file", 0))
            yield most - held + int(dropped)
        if folder == root:
            return


def _of_process() -> Iterator[int]:
    """The remaining address space of this process, if limited."""
    with suppress(ImportError, OSError, ValueError):
        import resource

        limit = resource.getrlimit(resource.RLIMIT_AS)[0]
        if limit != resource.RLIM_INFINITY:
            pages = int(Path("/proc/self/statm").read_text("ascii").split()[0])
            yield limit - pages * resource.getpagesize()
