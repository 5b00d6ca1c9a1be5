"""Checks of file paths, and files that appear only when they are complete."""

from __future__ import annotations

import os
import secrets
import shutil
import stat
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from lumencut.errors import FileError, FormatError

WRITABLE = "a place where files can be written"


def checked_path(path: Any, expected: str) -> Path:
    """Return ``path``, checked as the path of a file or folder that may not exist; nothing is opened.

    Parameters
    ----------
    path : path-like
        The argument of the caller.
    expected : str
        What the error says was expected.

    Raises
    ------
    FormatError
        For anything that is not a path.
    FileError
        For texts that cannot be the name of a file, and for pipes and devices.
    """
    try:
        checked = Path(path)
    except TypeError as error:
        raise FormatError("path", type(path).__name__, "a text or a pathlib.Path") from error
    text = os.fspath(path)
    if not text:
        raise FileError("path", "an empty text", expected)
    if "\0" in text:
        raise FileError(_short(text), "a null character", expected)
    try:
        os.fsencode(text)
        mode = checked.stat().st_mode
    except UnicodeEncodeError as error:
        raise FileError(_short(text), "characters that no file name can have", expected) from error
    except (FileNotFoundError, NotADirectoryError):
        return checked
    except OSError as error:
        raise FileError(_short(text), error.strerror or str(error), expected) from error
    if not (stat.S_ISREG(mode) or stat.S_ISDIR(mode)):
        raise FileError(_short(text), "a pipe or a device", expected, "name a plain file")
    return checked


def replace_whole(path: Path, write: Callable[[Path], object]) -> None:
    """Let ``write`` write a temporary file, then rename it to ``path``."""
    # In the folder of the link's target, because a move across disks is not atomic.
    place = Path(os.path.realpath(checked_path(path, WRITABLE)))
    with private_folder(path, place.parent) as folder:
        write(folder / "whole.part")
        move(folder / "whole.part", place)


def write_text(path: str | os.PathLike[str], text: str) -> None:
    """Write a text file that appears only when it is complete."""
    replace_whole(checked_path(path, WRITABLE), lambda whole: whole.write_text(text, "utf-8", newline="\n"))


@contextmanager
def private_folder(subject: Path, home: Path) -> Iterator[Path]:
    """Create a hidden folder in ``home`` that only this user can enter, and remove it at the end.

    An error of the system is reported as an error of ``subject``.
    """
    # The name is known before the folder is created, so a signal right afterwards cannot leave it behind.
    folder = home / f".lumencut.{secrets.token_hex(8)}.part"
    try:
        folder.mkdir(mode=0o700)
        yield folder
    except OSError as error:
        if isinstance(error, FileError):
            raise
        raise FileError(_short(str(subject)), error.strerror or str(error), WRITABLE) from error
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def move(whole: Path, path: Path) -> None:
    """Replace an old file by a new one; links are followed and the old permissions are kept.

    Without an old file, the new one keeps the default permissions of the user.
    """
    place = os.path.realpath(path)
    try:
        mode = stat.S_IMODE(os.stat(place).st_mode)
    except FileNotFoundError:
        mode = None
    if mode is not None and mode != stat.S_IMODE(whole.stat().st_mode):
        whole.chmod(mode)
    os.replace(whole, place)


def _short(text: str) -> str:
    """Return the text without unprintable characters, shortened if it is long."""
    shown = text if text.isprintable() else ascii(text)
    return shown if len(shown) <= 200 else shown[:197] + "..."
