"""The pictures that a command writes: every view into every output, with the view in the file name."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import click

from lumencut.cli.options import check_picture

PLACE = "{view}"


@dataclass(frozen=True)
class Picture:
    """One view, and the files into which it is written.

    Attributes
    ----------
    view : str, tuple of 3 float or None
        The name of the view, or its direction; None for the view of the picture of ``--like``.
    paths : tuple of Path
        The files.
    """

    view: Any
    paths: tuple[Path, ...]


def pictures(views: Sequence[Any], outputs: Sequence[Path]) -> list[Picture]:
    """Return the files of each view; files that cannot be written are rejected before anything is read.

    The name of the view replaces ``{view}`` in an output. If there are several views, an output without
    ``{view}`` gets the name of the view before its extension.
    """
    planned = [
        Picture(view, tuple(_path(output, view, is_one=len(views) == 1) for output in outputs))
        for view in views
    ]
    paths = [path for picture in planned for path in picture.paths]
    for n, path in enumerate(paths):
        if path.resolve() in {other.resolve() for other in paths[:n]}:
            raise click.UsageError(
                f"{path} would be written twice; give each view once, and each -o another name"
            )
        check_picture(path)
    return planned


def name_of(view: Any) -> str:
    """Return the name of a view in file names; three numbers for a direction."""
    return view if isinstance(view, str) else "_".join(f"{number:g}" for number in view)


def _path(output: Path, view: Any, *, is_one: bool) -> Path:
    if view is None:
        if PLACE in output.name:
            found = f"{PLACE} in {output} stands for the name of the view, which a picture does not store"
            raise click.UsageError(f"{found}; give --view with --like, or another name")
        return output
    name = name_of(view)
    if PLACE in output.name:
        return output.with_name(output.name.replace(PLACE, name))
    return output if is_one else output.with_name(f"{output.stem}-{name}{output.suffix}")
