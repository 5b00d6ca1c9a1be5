"""The result of an evaluation, and the files that it can write."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from lumencut.base.csv_cells import written
from lumencut.base.paths import WRITABLE, checked_path, write_text
from lumencut.base.pickles import by_name
from lumencut.errors import FileError, VolumeError
from lumencut.evaluation.methods import METHODS
from lumencut.pictures.renderer import Renderer
from lumencut.scene.camera import Camera
from lumencut.scene.settings import Settings

#: A row of a table: names, numbers, and None for undefined numbers.
Row = dict[str, str | float | int | None]

_WORST = "lumen_within_0.05_mm_percent"


@by_name
@dataclass(frozen=True, eq=False, repr=False)
class Evaluation:
    """The result of :func:`lumencut.evaluate`.

    Attributes
    ----------
    table : list of dict
        A row for each method: its name under ``"method"``, and the numbers over all views.
    views : list of dict
        The same for each method and each view; ``"view"`` is the number of the view, from 0.
    cameras : tuple of Camera
        The cameras of the views.
    settings : dict of str to Settings
        The settings of each method.
    """

    table: list[Row]
    views: list[Row]
    cameras: tuple[Camera, ...]
    settings: dict[str, Settings]
    _renderer: Renderer = field(repr=False)
    # The first column of each criterion.
    _first: dict[str, str] = field(repr=False)

    def __repr__(self) -> str:
        """Return the names of the methods and the number of views."""
        return f"Evaluation({', '.join(self.settings)}: {len(self.cameras)} views)"

    def worst_view(self, method: str) -> int:
        """Return the number of the view in which the smallest share of lumen pixels shows the exact depth.

        If several views are equal, or no pixel is in a lumen, the first view is returned.
        """
        shares = [row[_WORST] for row in self.views if row["method"] == method]
        known = [share if isinstance(share, float) else 101.0 for share in shares]
        return known.index(min(known))

    def to_csv(self, path: str | os.PathLike[str]) -> None:
        """Write the table as CSV with a line for each method; the file appears only when complete.

        Numbers keep all their digits; None becomes empty.

        Raises
        ------
        FileError
            If the file cannot be written.
        """
        names = list(self.table[0])
        write_text(path, written([names, *([row[name] for name in names] for row in self.table)]))

    def to_markdown(self) -> str:
        """Return the table as Markdown: a line for each number, a column for each method.

        The numbers are grouped by the criteria of the questionnaire in section 5 of the paper: lumen,
        surroundings, visibility, depth and silhouettes.
        """
        rows = []
        for name in self.table[0]:
            if name in self._first:
                rows.append([f"**{self._first[name]}**", *("" for _ in self.table)])
            rows.append([name, *(_formatted(row[name]) for row in self.table)])
        return _markdown(rows)

    def save_pictures(self, folder: str | os.PathLike[str]) -> list[Path]:
        """Write a picture of each method's worst view, named after the method, into a folder.

        The folder is created if missing. See :meth:`worst_view`.

        Returns
        -------
        list of Path
            The pictures, in the order of the methods.

        Raises
        ------
        VolumeError
            If the evaluation had no volume.
        FileError
            If the folder cannot be written to.
        """
        if self._renderer.volume is None:
            raise VolumeError("pictures of the evaluation", "no volume", "a volume to show")
        place = checked_path(folder, WRITABLE)
        try:
            place.mkdir(exist_ok=True)
        except OSError as error:
            raise FileError(str(place), error.strerror or str(error), "a folder to write into") from error
        paths = []
        for name, settings in self.settings.items():
            camera = self.cameras[self.worst_view(name)]
            METHODS[name].picture(self._renderer, camera, settings).save(place / f"{name}.png")
            paths.append(place / f"{name}.png")
        return paths


def _formatted(value: str | float | int | None) -> str:
    """Return a number with four significant digits."""
    if value is None:
        return "-"
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def _markdown(rows: Sequence[Sequence[str]]) -> str:
    """Return rows as a Markdown table; the first row is its head, and numbers are right-aligned."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    rule = ["-" * widths[0], *("-" * (width - 1) + ":" for width in widths[1:])]
    lines = [
        f"| {row[0]:<{widths[0]}} | " + " | ".join(map(str.rjust, row[1:], widths[1:])) + " |"
        for row in [rows[0], rule, *rows[1:]]
    ]
    return "\n".join(lines) + "\n"
