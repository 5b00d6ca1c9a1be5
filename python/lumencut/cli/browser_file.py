"""A file that redirects a browser to the viewer: only its owner can read it.

All users of a machine see the command line of a browser, so it must not contain the secret.
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
    # Without locks: Windows does not remove open files, which protects a file in use as well.
    fcntl = None  # type: ignore[assignment]

_NAMES = "open-*.html"
#: The file runs no script and loads nothing; a browser that does not redirect shows the link.
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
    """Write a file that redirects a browser to an address, and remove it at the end.

    Yields
    ------
    Path or None
        The file; None if there is no folder that only this user can read.
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
        os.close(descriptor)
        _remove(file)
        with suppress(OSError):
            folder.rmdir()


def _folders() -> Iterator[Path]:
    """Yield the folders that may hold the file, the best one first.

    A browser installed as a snap cannot read the runtime folder, hidden folders of the home, or ``/tmp``. A
    browser installed as a flatpak can open the file in any folder.
    """
    visible = _home() / "lumencut-viewer"
    if (_home() / "snap").is_dir():
        yield visible
    runtime = Path(os.environ.get("XDG_RUNTIME_DIR", ""))
    if runtime.is_absolute() and _is_private(runtime):
        yield runtime / "lumencut"
    yield visible
    yield Path(tempfile.gettempdir()) / f"lumencut-viewer-{_user()}"


def _home() -> Path:
    return Path(os.path.expanduser("~"))


def _user() -> int:
    return os.geteuid() if hasattr(os, "geteuid") else 0


def _is_private(folder: Path) -> bool:
    """Return whether a folder belongs to this user, and is closed to all others."""
    if os.name != "posix":
        # On Windows user folders are private; file modes do not show this.
        return True
    try:
        found = folder.lstat()
    except OSError:
        return False
    return stat.S_ISDIR(found.st_mode) and found.st_uid == _user() and not found.st_mode & 0o077


def _written(folder: Path, text: str) -> tuple[int, Path]:
    """Write the file into this folder, and keep it open and locked to mark it as in use."""
    with suppress(FileExistsError):
        folder.mkdir(0o700)
    if not _is_private(folder):
        raise PermissionError(f"{folder} is open to other users")
    with _alone_in(folder):
        _remove_unused(folder)
        # A new file that only this user can read and write.
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
    """Remove files left by viewers that were killed."""
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
    """Let no other process clean the folder between the creation and the locking of a file."""
    if fcntl is None:
        yield
        return
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        # Some file systems cannot lock folders.
        with suppress(OSError):
            fcntl.flock(descriptor, fcntl.LOCK_EX)
        yield
    finally:
        os.close(descriptor)


def _lock(descriptor: int) -> bool:
    """Lock an open file, and return whether it succeeded; False on a file system without locks."""
    if fcntl is None:
        return True
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True
