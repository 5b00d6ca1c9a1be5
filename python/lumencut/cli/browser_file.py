"""A file that leads a browser on to the viewer: every user may see its name, its owner alone what it holds.

All users of a machine see the command line of a browser, so no secret may stand there.
"""

from __future__ import annotations

import html
import os
import stat
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

try:
    import fcntl
except ImportError:
    # Windows removes no file that is open, which serves as well.
    fcntl = None  # type: ignore[assignment]

_NAMES = "open-*.html"
#: No script runs and nothing is loaded; a browser that does not follow by itself shows the link.
_TEXT = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="referrer" content="no-referrer">
<meta http-equiv="refresh" content="0; url={address}">
<title>Lumencut</title>
</head>
<body><a href="{address}" rel="noreferrer">Open the viewer</a></body>
</html>
"""


@contextmanager
def leading_to(address: str) -> Iterator[Path | None]:
    """Write a file that leads a browser to an address, and remove it at the end.

    Yields
    ------
    Path or None
        The file; None where no folder can hold it that only this user reads.
    """
    text = _TEXT.format(address=html.escape(address))
    for folder in _folders():
        with suppress(OSError):
            descriptor, file = _written(folder, text)
            break
    else:
        yield None
        return
    try:
        yield file
    finally:
        # In this order: Windows removes no file that is open.
        os.close(descriptor)
        _remove(file)
        with suppress(OSError):
            folder.rmdir()


def _folders() -> Iterator[Path]:
    """Yield the folders that may hold the file, the best one first.

    A browser from a snap reads neither the runtime folder, nor hidden folders of the home, nor ``/tmp``. One
    from a flatpak is handed the file wherever it is.
    """
    visible = _home() / "lumencut-viewer"
    if (_home() / "snap").is_dir():
        yield visible
    runtime = Path(os.environ.get("XDG_RUNTIME_DIR", ""))
    if runtime.is_absolute() and _is_private(runtime):
        yield runtime / "lumencut"
    yield visible
    # A user may have no home.
    yield Path(tempfile.gettempdir()) / f"lumencut-viewer-{_user()}"


def _home() -> Path:
    return Path(os.path.expanduser("~"))


def _user() -> int:
    return os.geteuid() if hasattr(os, "geteuid") else 0


def _is_private(folder: Path) -> bool:
    """Tell whether a folder belongs to this user, and is closed to all others."""
    if os.name != "posix":
        # Folders of a user are closed to others there, and modes say nothing of it.
        return True
    try:
        found = folder.lstat()
    except OSError:
        return False
    return stat.S_ISDIR(found.st_mode) and found.st_uid == _user() and not found.st_mode & 0o077


def _written(folder: Path, text: str) -> tuple[int, Path]:
    """Write the file into a folder of its own, and keep it open and locked, which says that it is in use."""
    with suppress(FileExistsError):
        folder.mkdir(0o700)
    if not _is_private(folder):
        raise PermissionError(f"{folder} is open to other users")
    with _alone_in(folder):
        _remove_unused(folder)
        # Only this user reads and writes it, and it is new.
        descriptor, name = tempfile.mkstemp(".html", "open-", folder)
        try:
            _lock(descriptor)
            os.write(descriptor, text.encode())
        except BaseException:
            os.close(descriptor)
            _remove(Path(name))
            raise
    return descriptor, Path(name)


def _remove_unused(folder: Path) -> None:
    """Remove what runs that were killed left behind."""
    for file in folder.glob(_NAMES):
        with suppress(OSError):
            descriptor = os.open(file, os.O_RDWR)
            is_unused = _lock(descriptor)
            os.close(descriptor)
            if is_unused:
                _remove(file)


def _remove(file: Path) -> None:
    with suppress(OSError):
        file.unlink()


@contextmanager
def _alone_in(folder: Path) -> Iterator[None]:
    """Keep other runs out, whose file may be there and not be locked yet."""
    if fcntl is None:
        yield
        return
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        # Some disks have no locks for folders.
        with suppress(OSError):
            fcntl.flock(descriptor, fcntl.LOCK_EX)
        yield
    finally:
        os.close(descriptor)


def _lock(descriptor: int) -> bool:
    """Lock an open file, and tell whether nobody else has; False where the disk has no locks."""
    if fcntl is None:
        return True
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True
