"""Session files: the work of a reader on a scan in the viewer, for use on the command line.

A session file is a 3D Slicer markups file, so :func:`lumencut.read_centerlines` reads its vessels. It
also holds colours, marks and the view; this module reads them. The core checks the entire file.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from lumencut import _lumencut
from lumencut.base.paths import checked_path
from lumencut.errors import CameraError, FileError, FormatError, SettingsError
from lumencut.measuring.measured_vessel import Marked
from lumencut.pictures.recipe import Recipe
from lumencut.scene.camera import Camera
from lumencut.scene.focus import Focus
from lumencut.scene.settings import Settings
from lumencut.scene.slab import Slab
from lumencut.scene.transfer import TransferFunction
from lumencut.scene.window import Window

_EXPECTED = "a session file of the viewer (.mrk.json)"
_MEND = "save the session again in the viewer"


@dataclass(frozen=True)
class SessionFile:
    """The content of a session file other than the lines of its vessels.

    Attributes
    ----------
    path : Path
        The file.
    recipe : Recipe or None
        The view; None if the file has none.
    marks : tuple of Marked
        The marks on each vessel, in the order of the file.
    hidden : tuple of int
        The ids of the vessels that the viewer did not show.
    fwhm : float or None
        The full width at half maximum of the point spread that the reader gave (mm); None where it was
        estimated.
    contours : int
        The number of contours that the reader drew.
    by_hand : dict
        By id, whether the reader moved each point of a vessel's line.
    """

    path: Path
    recipe: Recipe | None
    marks: tuple[Marked, ...]
    hidden: tuple[int, ...]
    fwhm: float | None
    contours: int = 0
    by_hand: dict[str, list[bool]] = field(default_factory=dict)


def is_session_file(path: Path) -> bool:
    """Return whether a readable file is a session file; other readers report the rest."""
    if path.suffix.lower() != ".json":
        return False
    try:
        return _lumencut.is_session_file(path.read_bytes())
    except OSError:
        return False


def read_session(path: str | Path) -> SessionFile:
    """Return the content of a session file other than its vessels.

    Raises
    ------
    FormatError
        For a file that is no session, is damaged, or has a view that cannot be rendered.
    FileError
        For a file that cannot be read.
    """
    place = checked_path(path, _EXPECTED)
    try:
        content = place.read_bytes()
    except OSError as error:
        raise FileError(str(place), error.strerror or str(error), _EXPECTED) from error
    session = json.loads(_lumencut.read_session_file(content, str(place)))
    vessels = session["vessels"]
    hidden = tuple(number for number, vessel in enumerate(vessels) if vessel["hidden"])
    marks = tuple(_marked(vessel["marks"]) for vessel in vessels)
    view = session["view"]
    shown = len(vessels) - len(hidden)
    recipe = None if view is None else _recipe(place, view, shown)
    contours = sum(len(vessel.get("contours_mm", ())) for vessel in vessels)
    by_hand = {str(n): vessel["by_hand"] for n, vessel in enumerate(vessels) if "by_hand" in vessel}
    return SessionFile(place, recipe, marks, hidden, session["fwhm_mm"], contours, by_hand)


def _marked(marks: dict[str, Any] | None) -> Marked:
    if marks is None:
        return Marked()
    lengths = (marks[f"{name}_mm"] for name in ("at", "references", "original", "comparison"))
    at, references, original, comparison = lengths
    diameters = tuple(marks.get("diameters_mm", ()))
    return Marked(at, tuple(references), marks["method"], original, comparison, marks["group"], diameters)


def _recipe(path: Path, view: dict[str, Any], vessels: int) -> Recipe:
    if view["method"] not in ("csr", "csr-paper"):
        found = f"a view by the method {view['method']}"
        mend = "choose CSR in the viewer and save the session again"
        raise FormatError(str(path), found, "one by csr or csr-paper", mend)
    try:
        settings = view_settings(view["method"], view["settings"])
        camera = Camera(**{**view["camera"], "size": tuple(view["camera"]["size"])})
    except (SettingsError, CameraError, TypeError, ValueError) as error:
        found = f"a view that cannot be rendered ({error})"
        raise FormatError(str(path), found, _EXPECTED, _MEND) from error
    return Recipe(camera, settings, annotate=True, vessel_names=False, vessels=vessels)


def view_settings(method: str, given: dict[str, Any]) -> Settings:
    """Return the settings of a view of the viewer, which lists those that differ from the defaults.

    Parameters
    ----------
    method : str
        The name of its method; ``"csr-paper"`` has other usual settings.
    given : dict
        The settings by their names, as JSON holds them.

    Raises
    ------
    SettingsError, TypeError, ValueError
        For invalid values of a setting.
    """
    make = Settings.paper if method == "csr-paper" else Settings
    return make(**{name: _made(name, value) for name, value in given.items()})


def _made(name: str, value: Any) -> Any:
    """Return a setting from its form in the viewer: windows and slabs are pairs, colours and points lists."""
    setting = _lumencut.SETTINGS.get(name)
    if setting is None or not isinstance(value, list):
        return value
    if setting.kind == "transfer":
        return TransferFunction(tuple(value))
    made = {"window": Window, "slab": Slab, "focus": Focus}.get(setting.kind)
    return tuple(value) if made is None else made(*value)
