"""Endoscopy: the wall of a vessel as an eye on its centerline sees it."""

from __future__ import annotations

import functools
import math
import warnings
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.base.checks import number
from lumencut.errors import CameraError, LineWarning
from lumencut.measuring.profile import Profile
from lumencut.pictures.reformation_recipe import ReformationRecipe
from lumencut.pictures.renderer import Renderer
from lumencut.pictures.value_colours import with_scale
from lumencut.reformations.reformation import Reformation
from lumencut.reformations.unrolled_wall import Ostium
from lumencut.scene.settings import Settings
from lumencut.scene.vessel_tree import VesselTree
from lumencut.scene.window import Window

Lens: TypeAlias = Literal["perspective", "fisheye"]


@dataclass(frozen=True)
class SeenVessel:
    """What the endoscopies of one vessel have in common."""

    renderer: Renderer
    inside: _lumencut.Inside
    profile: Profile | None
    tree: VesselTree | None


class Endoscopy(Reformation):
    """The inside of a vessel as an image (H, W), made by :func:`lumencut.endoscopy`.

    Each pixel is a ray from the eye. A world point has the pixel of its direction, NaN outside the image and
    behind the wall. No pixel is folded. `pixel_spacing` is the side of the middle pixel at a distance of
    1 mm.

    Attributes
    ----------
    at : float
        The place of the eye along the vessel (mm).
    lens : {"perspective", "fisheye"}
        How directions become pixels.
    profile : Profile or None
        The measured profile; None if no lumen could be measured.
    """

    _core: _lumencut.Endoscopy
    _arrays = (*Reformation._arrays, "depth", "distance", "open")

    def __init__(self, seen: SeenVessel, given: Settings, parameters: dict[str, Any]) -> None:
        self._seen, self._wanted = seen, parameters
        self.at: float = parameters["at"]
        self.lens: Lens = parameters["lens"]
        self.profile: Profile | None = seen.profile
        core = seen.inside.seen(
            seen.renderer.volume,
            self.at,
            (self.lens, parameters["field_of_view"]),
            (int(parameters["size"][0]), int(parameters["size"][1])),
            (parameters["roll"], parameters["backwards"]),
        )
        axes = _lumencut.axes_words("endoscopy", self.at)
        recipe = ReformationRecipe(f"endoscopy at {self.at:.1f} mm", axes, parameters, "endoscopy")
        super().__init__(seen.renderer, core, given, recipe, measurable=False)

    def changed(self, at: float | None = None, roll: float | None = None) -> Endoscopy:
        """Return the view from another place; the wall is reused.

        Parameters
        ----------
        at : float, optional
            The place of the eye along the vessel (mm); unchanged by default.
        roll : float, optional
            Turn of the picture clockwise (radians); unchanged by default.

        Raises
        ------
        CameraError
            As for :func:`lumencut.endoscopy`.
        """
        own = {name: finite(name, value) for name, value in (("at", at), ("roll", roll)) if value is not None}
        return Endoscopy(self._seen, self._given, {**self._wanted, **own})

    @functools.cached_property
    def depth(self) -> npt.NDArray[np.float32]:
        """Length of the ray from the eye to the wall (mm), float32, shape (H, W), NaN where it meets none."""
        return self._core.depth()

    @functools.cached_property
    def distance(self) -> npt.NDArray[np.float64]:
        """Distance of the wall from the centerline (mm), float64, shape (H, W), NaN in openings."""
        return self._core.radius()

    @functools.cached_property
    def open(self) -> npt.NDArray[np.bool_]:
        """Which pixels look through an opening of the wall or beyond an end, bool, shape (H, W)."""
        return self._core.open()

    @property
    def doubts(self) -> tuple[str, ...]:
        """Why the picture may be wrong: an eye outside the lumen, a lumen narrower than a voxel."""
        return tuple(self._seen.inside.doubts(self._renderer.volume, self._core))

    @functools.cached_property
    def ostia(self) -> tuple[Ostium, ...]:
        """The openings of other vessels of the tree into this one, by their ids; NaN as pixel if not seen."""
        tree = self._seen.tree
        if tree is None:
            return ()
        rows = self._seen.inside.ostia(self._core, [(one.points, one.radius) for one in tree])
        return tuple(
            Ostium(vessel, tree[vessel].name, at, np.array(point), np.array(pixel))
            for vessel, at, point, pixel in rows
        )

    @property
    def shown_window(self) -> Window | None:
        """None: the picture has its own colours."""
        return None

    def _look(self, settings: Settings, *images: str) -> dict[str, Any]:
        return self._shown(self._core.behind(), settings, *images)

    @functools.cached_property
    def image(self) -> npt.NDArray[np.uint8]:
        """RGBA picture, uint8, shape (H, W, 4); transparent where no wall is met.

        Brightness is the light of the eye on the wall. The colour is that of the volume 1 mm behind the wall:
        calcium and metal are white.
        """
        return self._seen.inside.picture(self._core.shades(self._renderer.volume), self.value)

    def annotated(self, *, vessel_names: bool = True) -> npt.NDArray[np.uint8]:
        """Return the picture with labels, RGBA, uint8; a side below 200 pixels gets none.

        The labels are those of every reformation, and the names of vessels at their openings.
        """
        image = super().annotated(vessel_names=vessel_names)
        seen = [one for one in self.ostia if np.isfinite(one.pixel).all()]
        places = [((one.name if vessel_names else None) or str(one.vessel), one.pixel) for one in seen]
        return with_scale(image, places, None)

    def _edges(self) -> dict[str, str]:
        _, right, up, _ = np.array(self._core.eye())
        return dict(_lumencut.edge_letters(right, -up))

    def warn(self) -> None:
        """Warn the caller of the doubts."""
        for doubt in self.doubts:
            warnings.warn(LineWarning(f"endoscopy: {doubt}"), stacklevel=4)

    def __repr__(self) -> str:
        """Return the place and the size."""
        width, height = self.size
        return f"Endoscopy({self.lens}, at {self.at:.4g} mm, {width} × {height} pixels)"


def finite(name: str, value: Any) -> float:
    """Return a number of the endoscopy that is finite."""
    found = number(CameraError, f"{name} of the endoscopy", value)
    if not math.isfinite(found):
        raise CameraError(f"{name} of the endoscopy", f"{found:g}", "a finite number")
    return found
