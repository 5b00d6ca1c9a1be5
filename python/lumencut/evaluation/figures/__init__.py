"""The paper's figures and tables, made from open data and phantoms."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Literal

from lumencut.base.checks import flag
from lumencut.base.paths import WRITABLE, checked_path, replace_whole, write_text
from lumencut.errors import FileError, SettingsError
from lumencut.evaluation.figures import method_figures, scan_figures, tables
from lumencut.evaluation.figures.drawing import Picture
from lumencut.evaluation.figures.figure import Figure
from lumencut.evaluation.figures.page import file_name, html_page
from lumencut.evaluation.figures.scenes import Scenes

__all__ = ["FIGURES", "make_figures"]

#: What makes each figure and table, by its name in ``only``.
FIGURES: dict[str, Callable[[Scenes], Figure]] = {
    "1": scan_figures.bifurcation,
    "2": method_figures.cost_of_a_knot,
    "3": method_figures.levels_of_an_uneven_line,
    "5": method_figures.zones_and_lines,
    "6": method_figures.steps_of_the_method,
    "7": scan_figures.bypass,
    "8": scan_figures.neck,
    "9": tables.criteria,
    "table-1": tables.aspects,
    "table-2": tables.timings,
}


def make_figures(
    folder: str | os.PathLike[str],
    only: Iterable[str] | None = None,
    *,
    quick: bool = False,
    device: Literal["auto", "cpu", "gpu"] = "auto",
    progress: Callable[[int, int], object] | None = None,
) -> list[str]:
    """Write the paper's figures as PNG files, and ``index.html``, which shows them.

    Pictures by the paper's rules (:meth:`Settings.paper`) and by the defaults have the same view and window.

    Parameters
    ----------
    folder : str or path
        The folder; made if missing. Files of the same names are replaced.
    only : iterable of str, optional
        Names from ``FIGURES``, such as ``"1"`` or ``"table-2"``; all by default.
    quick : bool, default False
        Pictures of 256 × 256 instead of 512 × 512 pixels, and smaller phantoms.
    device : {"auto", "cpu", "gpu"}, default "auto"
        The device, as for :class:`Renderer`.
    progress : callable, optional
        Called with (done, total), the numbers of finished figures and of all.

    Returns
    -------
    list of str
        The names of the written files, the page last.

    Raises
    ------
    SettingsError
        For an unknown figure.
    FileError
        If the folder cannot be made or written.
    """
    names = list(FIGURES) if only is None else _checked(only)
    path = checked_path(folder, WRITABLE)
    scenes = Scenes(flag(SettingsError, "quick", quick), device)
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FileError(str(path), error.strerror or str(error), "a folder that can be written") from error
    made, written = [], []
    for done, name in enumerate(names):
        if progress is not None:
            progress(done, len(names))
        figure = FIGURES[name](scenes)
        for panel in figure.panels:
            for rule, picture in panel.pictures.items():
                file = file_name(figure, panel, rule)
                _write(path / file, picture)
                written.append(file)
        made.append(figure)
    from lumencut import __version__

    write_text(path / "index.html", html_page(made, __version__))
    if progress is not None:
        progress(len(names), len(names))
    return [*written, "index.html"]


def _write(path: Path, picture: Picture) -> None:
    from PIL import Image

    replace_whole(path, lambda whole: Image.fromarray(picture).save(whole, "PNG"))


def _checked(only: Iterable[str]) -> list[str]:
    """Return the names of figures in the order of the paper."""
    wanted = [only] if isinstance(only, str) else list(only)
    for name in wanted:
        if name not in FIGURES:
            raise SettingsError("figure", repr(name), f"one of {', '.join(FIGURES)}")
    if not wanted:
        raise SettingsError("figures", "none", f"one or more of {', '.join(FIGURES)}")
    return [name for name in FIGURES if name in wanted]
