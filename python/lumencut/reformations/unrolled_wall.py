"""Lumen map: the wall of a vessel cut open along it and unrolled."""

from __future__ import annotations

import functools
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.base.checks import choice
from lumencut.base.pickles import by_name
from lumencut.errors import MeasuringError, SettingsError
from lumencut.measuring.profile import Profile
from lumencut.pictures.reformation_recipe import ReformationRecipe
from lumencut.pictures.renderer import Renderer
from lumencut.pictures.value_colours import coloured, with_scale
from lumencut.reformations.planar_reformation import one_angle
from lumencut.reformations.reformation import Reformation
from lumencut.scene.settings import Settings
from lumencut.scene.vessel_tree import VesselTree
from lumencut.scene.window import Window

Mode: TypeAlias = Literal["wall", "radius", "thickness", "shaded"]

MODES = ("wall", "radius", "thickness", "shaded")

#: The name of each mode in the labels, and the unit of its colours.
_SHOWN = {
    "wall": ("lumen map of the wall", None),
    "radius": ("lumen map of the radius", "mm"),
    "thickness": ("lumen map of calcium", "mm thick"),
    "shaded": ("lumen map, shaded", None),
}

#: Brightness of the columns that repeat the other side of the wall.
_DIMMED = 0.55


@by_name
@dataclass(frozen=True)
class Ostium:
    """The opening of another vessel of the tree into the mapped one.

    Attributes
    ----------
    vessel : int
        The id of the other vessel in its tree.
    name : str or None
        Its name.
    arc_length : float
        The place along the mapped vessel (mm).
    point : numpy.ndarray, shape (3,)
        The point of the other vessel where it leaves the wall (mm, LPS).
    pixel : numpy.ndarray, shape (2,)
        Column and row in the map.
    """

    vessel: int
    name: str | None
    arc_length: float
    point: npt.NDArray[np.float64]
    pixel: npt.NDArray[np.float64]


@dataclass(frozen=True)
class MappedVessel:
    """What the maps of one vessel have in common."""

    renderer: Renderer
    wall: _lumencut.LumenWall
    profile: Profile | None
    tree: VesselTree | None


class LumenMap(Reformation):
    """The wall of a vessel as an image (H, W), made by :func:`lumencut.lumen_map`.

    Rows are along the vessel, columns go once around it; both edges are the same line of the wall. A world
    point has the pixel of its direction around the vessel, wherever it lies on that ray; NaN before and
    beyond the vessel. A pixel is folded where another part of the vessel is nearer, or sections have met.

    Attributes
    ----------
    mode : {"wall", "radius", "thickness", "shaded"}
        What is shown.
    angle : float
        The direction of the middle column around the vessel (radians); 0 is to the right of the straightened
        CPR at angle 0, and a quarter of a turn is into its picture.
    mean_radius : float
        The radius at which columns are true (mm).
    overlap : int
        How many columns on each side repeat the other side, dimmed in the picture.
    calcium_level : float or None
        Level from which something at the wall counts as calcium or metal, in the volume's unit; None if none
        was given and no lumen could be measured.
    profile : Profile or None
        The measured profile. None if no lumen could be measured: the wall is then the radius of the
        centerline.
    """

    _core: _lumencut.LumenMap

    def __init__(self, mapped: MappedVessel, settings: Settings, mode: Mode, wanted: dict[str, Any]) -> None:
        self.mode: Mode = mode
        self._mapped, self._wanted = mapped, wanted
        self.mean_radius: float = mapped.wall.mean_radius
        self.profile: Profile | None = mapped.profile
        level = wanted["calcium_level"]
        self.calcium_level: float | None = mapped.wall.calcium_level if level is None else level
        self._band = _band_of(mode, wanted["band"])
        directions = (wanted["angle"], wanted["overlap"])
        core = mapped.wall.map(
            mapped.renderer.volume, wanted["pixel_spacing"], directions, self._band, self.calcium_level
        )
        axes = _lumencut.axes_words("map", self.mean_radius)
        recipe = ReformationRecipe(
            _SHOWN[mode][0], axes, {"mode": mode, **wanted, "angle": core.angle}, "map"
        )
        super().__init__(mapped.renderer, core, settings, recipe, measurable=False)

    def changed(
        self, mode: Mode | None = None, angle: float | None = None, *, degrees: float | None = None
    ) -> LumenMap:
        """Return the map of the same wall in another mode or turned; the wall is reused.

        Parameters
        ----------
        mode : {"wall", "radius", "thickness", "shaded"}, optional
            What is shown; unchanged by default.
        angle : float, optional
            The direction of the middle column (radians); unchanged by default.
        degrees : float, optional
            The angle in degrees, instead of ``angle``.

        Raises
        ------
        SettingsError, CameraError, MeasuringError
            As for :func:`lumen_map`.
        """
        shown = self.mode if mode is None else mode
        choice(SettingsError, "mode of the lumen map", shown, MODES)
        turned = (
            self.angle
            if angle is None and degrees is None
            else one_angle(0.0 if angle is None else angle, degrees)
        )
        return LumenMap(self._mapped, self._given, shown, {**self._wanted, "angle": turned})

    @property
    def angle(self) -> float:
        """The direction of the middle column around the vessel (radians)."""
        return self._core.angle

    @property
    def overlap(self) -> int:
        """How many columns on each side repeat the other side."""
        return self._core.overlap

    @property
    def shown_window(self) -> Window | None:
        """The window of ``"wall"``; None in the other modes, whose picture has its own scale."""
        return super().shown_window if self.mode == "wall" else None

    @functools.cached_property
    def ostia(self) -> tuple[Ostium, ...]:
        """The openings of other vessels of the tree into this one, in the order of their ids."""
        tree = self._mapped.tree
        if tree is None:
            return ()
        rows = self._core.ostia([(one.points, one.radius) for one in tree])
        return tuple(
            Ostium(vessel, tree[vessel].name, at, np.array(point), np.array(pixel))
            for vessel, at, point, pixel in rows
        )

    @functools.cached_property
    def wall(self) -> npt.NDArray[np.float64]:
        """The distance of the wall from the centerline (mm), float64, shape (H, W), also where it is open."""
        return self._core.wall()

    @functools.cached_property
    def open(self) -> npt.NDArray[np.bool_]:
        """Which pixels lie in the opening of a branch, where no wall was met, bool, shape (H, W)."""
        return self._core.open()

    @functools.cached_property
    def value(self) -> npt.NDArray[np.float32]:
        """The shown quantity, float32, shape (H, W), NaN in openings of branches and outside the volume.

        ``"wall"``: the volume in its unit; ``"radius"`` and ``"thickness"``: mm; ``"shaded"``: 0 to 1.
        """
        if self.mode == "wall":
            value: npt.NDArray[np.float32] = self._look(self._given, "value")["value"]
            return value
        return np.where(self.open, np.float32(np.nan), self._measured())

    def _measured(self) -> npt.NDArray[np.float32]:
        """Return the shown quantity for all modes except ``"wall"``."""
        if self.mode == "radius":
            return self.wall.astype(np.float32)
        if self.mode == "shaded":
            return self._core.shades()
        if self.calcium_level is None:
            found = "no level, for a vessel whose lumen could not be measured"
            raise MeasuringError("calcium_level of the lumen map", found, "a level", "give calcium_level=")
        return self._core.thickness(self._renderer.volume, self._band, self.calcium_level)

    @functools.cached_property
    def image(self) -> npt.NDArray[np.uint8]:
        """RGBA picture, uint8, shape (H, W, 4); openings and what lies outside the volume are transparent."""
        if self.mode == "wall":
            image: npt.NDArray[np.uint8] = self._look(self.settings, "image")["image"].copy()
        else:
            image = coloured(self.value, self._scale, "grey" if self.mode == "shaded" else "viridis")
        if self.overlap:
            for repeated in (image[:, : self.overlap, :3], image[:, -self.overlap :, :3]):
                repeated[:] = np.round(repeated * _DIMMED)
        return image

    @property
    def _scale(self) -> tuple[float, float]:
        """Return the values at both ends of the colour scale."""
        if self.mode == "shaded":
            return 0.0, 1.0
        return 0.0, _lumencut.scale_end(self.value)

    def annotated(self, *, vessel_names: bool = True) -> npt.NDArray[np.uint8]:
        """Return the picture with labels, RGBA, uint8; a side below 200 pixels gets none.

        The labels are those of every reformation, the names of vessels at their openings, and a scale of the
        colours where there are any.
        """
        image = super().annotated(vessel_names=vessel_names)
        places = [((one.name if vessel_names else None) or str(one.vessel), one.pixel) for one in self.ostia]
        unit = _SHOWN[self.mode][1]
        return with_scale(image, places, None if unit is None else (*self._scale, unit))


def _band_of(mode: Mode, band: list[float]) -> tuple[float, float]:
    """Return the band beyond the wall that a mode searches; for modes that show the wall, only the wall."""
    return (band[0], band[1]) if mode in ("wall", "thickness") else (0.0, 0.0)
