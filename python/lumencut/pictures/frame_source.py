"""What a frame was made from, for its labels and the text in its files."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from typing import TYPE_CHECKING, cast

from lumencut.base.pickles import by_name
from lumencut.pictures.value_colours import Legend
from lumencut.scene.settings import Settings
from lumencut.scene.study import Origin
from lumencut.scene.transfer import TransferFunction
from lumencut.scene.window import Window

if TYPE_CHECKING:
    from lumencut.scene.vessel_tree import VesselTree
    from lumencut.scene.volume import Volume

VesselEnd = tuple[str, tuple[float, float, float]]


@by_name
@dataclass(frozen=True)
class FrameSource:
    """What a frame was made from.

    Attributes
    ----------
    settings : Settings
        The settings, including the windows that were computed from the data.
    window : Window or None
        The window of the picture: of the cut surface, or of the context without one; None if it has none.
    states_spacing, states_orientation : bool
        As for the volume.
    vessels : int
        The number of shown vessels.
    vessel_ends : tuple of (str, (float, float, float))
        The name of each named vessel, and the point at which to write it.
    method : str, default "csr"
        The method: ``"csr"``, ``"mpcpr"`` or ``"cr"``.
    origin : Origin or None
        The scan in the form that DICOM objects need; None if the source was created by hand.
    legend : Legend or None
        What the colours of the rim mean; None without a rim.
    """

    settings: Settings
    window: Window | None
    states_spacing: bool
    states_orientation: bool
    vessels: int
    vessel_ends: tuple[VesselEnd, ...]
    method: str = "csr"
    origin: Origin | None = None
    legend: Legend | None = None


def frame_source(
    settings: Settings,
    volume: Volume,
    tree: VesselTree | None,
    ends: tuple[VesselEnd, ...],
    method: str = "csr",
    legend: Legend | None = None,
) -> FrameSource:
    """Return the source of a frame with these settings and windows; `ends` are those of the tree."""
    window = cast(Window | None, _context_window(settings) if tree is None else settings.window)
    vessels = 0 if tree is None else len(tree)
    return FrameSource(
        settings,
        window,
        volume.states_spacing,
        volume.states_orientation,
        vessels,
        ends,
        method,
        volume._origin,
        legend,
    )


def _context_window(settings: Settings) -> Window | str | None:
    """Return the window of the context; None if control points of a transfer function replace it."""
    has_points = isinstance(settings.context_transfer, TransferFunction)
    return None if has_points and settings.context in ("dvr", "mip") else settings.context_window


def vessel_ends(tree: VesselTree) -> tuple[VesselEnd, ...]:
    """Return the named vessels with one end each: the last point, or the first if only the first is free."""
    ends = [tuple(vessel.points[place].tolist()) for vessel in tree for place in (0, -1)]
    vessels_at = Counter(ends)
    found = []
    for number, vessel in enumerate(tree):
        first, last = ends[2 * number : 2 * number + 2]
        if vessel.name is not None:
            is_free = vessels_at[last] == 1 or vessels_at[first] > 1
            found.append((vessel.name, last if is_free else first))
    return tuple(found)
