"""Network map: a vessel tree as lines of true length, coloured by values along the vessels."""

from __future__ import annotations

import functools
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.base.checks import choice, number
from lumencut.errors import CameraError, SettingsError, VesselTreeError
from lumencut.pictures.reformation_recipe import ReformationRecipe
from lumencut.pictures.renderer import Renderer
from lumencut.pictures.value_colours import Legend, write_legend
from lumencut.reformations.request import pixel_side
from lumencut.reformations.untangled_tree import UntangledTree
from lumencut.reformations.untangling import UntangledRequest
from lumencut.scene.camera import Camera
from lumencut.scene.settings import Settings
from lumencut.scene.vessel_tree import VesselTree
from lumencut.scene.window import Window

Value: TypeAlias = Literal["diameter", "narrowing", "deviation", "uncertainty"]

#: Names of the setting ``rim``, which has the same values.
VALUES: tuple[str, ...] = _lumencut.SETTINGS["rim"].choices

#: Side of a pixel without a volume (mm).
_PIXEL = 0.25

#: Width of the map beyond the outermost vessels, in hull margins.
_MARGINS = 3.0


class NetworkMap(UntangledTree):
    """A vessel tree as coloured lines in an image (H, W), made by :func:`lumencut.network`.

    Its places are those of :class:`UntangledTree`. The lines are as wide as the vessels, and grey where a
    vessel has no value.

    Attributes
    ----------
    legend : Legend
        What the colours mean: ``words``, ``unit``, and the values ``low`` and ``high`` of the first and the
        last colour.
    """

    def __init__(self, along: _lumencut.ValuesAlong, asked: dict[str, Any], *of_tree: Any) -> None:
        super().__init__(*of_tree)
        axes = _lumencut.axes_words("network")
        self.recipe: ReformationRecipe = ReformationRecipe(
            "network map", axes, {**self.recipe.parameters, **asked}, "network"
        )
        self._along = along
        self.legend: Legend = Legend(*along.legend)

    @functools.cached_property
    def settings(self) -> Settings:
        """The settings; without a volume they have no window."""
        given = self._given
        return given if self._renderer.volume is None else self._renderer.windowed(given)

    @property
    def shown_window(self) -> Window | None:
        """None, because the map shows no values of the volume."""
        return None

    @functools.cached_property
    def image(self) -> npt.NDArray[np.uint8]:
        """RGBA picture, uint8, shape (H, W, 4); transparent outside the lines."""
        return self._core.network(self._along)

    def annotated(self, *, vessel_names: bool = True) -> npt.NDArray[np.uint8]:
        """Return the picture with labels, RGBA, uint8, shape (H, W, 4); a side below 200 pixels gets none.

        The labels are those of :class:`UntangledTree`, and the legend of the colours, on black.
        """
        from lumencut.pictures.lettering import SMALLEST_SIDE, Sheet

        image = super().annotated(vessel_names=vessel_names)
        # Labels are white, so lines lie on black.
        image[..., :3] = np.round(image[..., :3] * (image[..., 3:] / 255))
        image[..., 3] = 255
        if min(image.shape[:2]) < SMALLEST_SIDE:
            return image
        sheet = Sheet(image)
        write_legend(sheet, self.legend)
        return sheet.pixels()


def network(
    volume: Any,
    tree: VesselTree,
    profiles: Iterable[Any] = (),
    value: Value = "diameter",
    camera: Camera | None = None,
    hull_margin: float = 4.0,
    pixel_spacing: float | None = None,
) -> NetworkMap:
    """Return a vessel tree as a map: lines of true length, as wide as the vessels, coloured by a value.

    The layout is that of :func:`untangled`. Eulzer et al. 2022 (doi:10.1111/cgf.14576) survey such maps.

    Parameters
    ----------
    volume : Volume, or anything :func:`lumencut.render` takes as a volume, or None
        The angiography; the map itself does not need it.
    tree : VesselTree
        Its centerlines.
    profiles : iterable of Profile, or of (Profile, iterable of Stenosis), default ()
        Profiles of vessels of the tree, with their graded stenoses.
    value : {"diameter", "narrowing", "deviation", "uncertainty"}, default "diameter"
        The value, as for the setting ``rim``: diameters come from profiles, otherwise from radii; all else
        needs profiles.
    camera : Camera, optional
        From where the tree is seen, as for :func:`untangled`.
    hull_margin : float, default 4
        Margin around each vessel that no other may enter (mm).
    pixel_spacing : float, optional
        Side of a pixel; default: that of :func:`untangled`, or 0.25 mm without a volume.

    Raises
    ------
    MeasuringError
        For profiles of other vessels, and for values that no vessel has.
    VesselTreeError, CameraError, SettingsError, VolumeError, KeyboardInterrupt
        As for :func:`untangled`, and for another value.
    """
    if not isinstance(tree, VesselTree):
        raise VesselTreeError("tree", type(tree).__name__, "a VesselTree, such as read_centerlines returns")
    asked = NetworkRequest(camera, hull_margin, pixel_spacing, value)
    return asked.of(Renderer(volume, tree, "cpu", profiles=profiles))


@dataclass(frozen=True)
class NetworkRequest:
    """The parameters of :func:`network`."""

    camera: Camera | None = None
    hull_margin: float = 4.0
    pixel_spacing: float | None = None
    value: Value = "diameter"

    def of(self, renderer: Renderer) -> NetworkMap:
        """Return the map of the tree of a renderer, with its profiles."""
        choice(SettingsError, "value of the network map", self.value, VALUES)
        along = renderer._along.of(self.value)
        assert renderer.tree is not None, "values along the vessels have vessels"
        side = _PIXEL if renderer.volume is None else pixel_side(renderer.volume)
        width = _MARGINS * number(CameraError, "hull_margin of the network map", self.hull_margin)
        asked = UntangledRequest(self.camera, width, self.hull_margin, pixel_spacing=self.pixel_spacing)
        made = functools.partial(NetworkMap, along, {"value": self.value})
        return asked.laid_out(renderer, renderer.tree, side, made)
