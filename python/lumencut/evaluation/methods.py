"""The methods that can be evaluated: the settings of each, and how it makes a frame."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.base.checks import choice
from lumencut.errors import SettingsError
from lumencut.evaluation.own_pictures import untangled_picture
from lumencut.evaluation.shown import TURN, Shown, slid
from lumencut.pictures.frame import Frame, depth_before
from lumencut.pictures.renderer import Renderer
from lumencut.reformations.reformation import Reformation
from lumencut.reformations.tree_reformations import MPCPR, cr_method
from lumencut.scene.camera import Camera
from lumencut.scene.checked_settings import checked
from lumencut.scene.settings import Settings

#: Views of one degree each that a held view follows.
_VIEWS_BEFORE = 30


@dataclass(frozen=True)
class Method:
    """A method: a row of the table.

    Parameters
    ----------
    settings : function of Settings
        Returns the settings of the method, given those of the caller.
    surface : function of Renderer, Camera, Settings and the frame before in a turn
        Returns a frame with depth and vessel, and with values if there is a volume.
    picture : function of Renderer, Camera and Settings
        Returns a frame with a picture; needs a volume.
    details : function of Renderer, Camera, Settings and the frame before in a turn
        ``"sheet_gap"``, the arc length between the points that a pixel blends (mm), ``"strength"`` of the
        silhouettes and ``"rim"`` next to them (0 to 1), if the method has them.
    is_filtered : bool, default True
        Whether the depth filter of the settings changes the frame.
    has_image_per_vessel : bool, default False
        Whether it makes a separate frame for each vessel.
    own_picture : function of Renderer, Camera and Settings, optional
        Returns a picture whose pixels are not those of the view; then less can be counted.
    """

    settings: Callable[[Settings], Settings]
    surface: Callable[[Renderer, Camera, Settings, Frame | None], Frame]
    picture: Callable[[Renderer, Camera, Settings], Frame | Reformation]
    details: Callable[[Renderer, Camera, Settings, Frame | None], dict[str, npt.NDArray[np.float32]]]
    is_filtered: bool = True
    has_image_per_vessel: bool = False
    own_picture: Callable[[Renderer, Camera, Settings], Reformation] | None = None


def _own(settings: Settings) -> Settings:
    return settings


def _paper(settings: Settings) -> Settings:
    """Return the settings with the paper's rules."""
    return replace(settings, **_lumencut.PAPER)


def _surface(renderer: Renderer, camera: Camera, settings: Settings, before: Frame | None = None) -> Frame:
    if renderer.volume is None:
        return renderer.cut_surface(camera, settings, before=before)
    # These settings change neither depth nor vessel nor value, but take time.
    bare = replace(settings, context=None, silhouettes=False, samples=1)
    return renderer.render(camera, bare, images=("depth", "vessel", "value"), before=before)


def _before(renderer: Renderer, camera: Camera, settings: Settings) -> Frame | None:
    """Return the view one degree before in a turn, if the settings hold on to it."""
    before = None
    if settings.turning_limit is not None:
        for n in range(_VIEWS_BEFORE, 0, -1):
            turned = camera.rotated(-n * TURN, "up")
            before = renderer.cut_surface(turned, settings, images=["depth"], before=before)
    return before


def _picture(renderer: Renderer, camera: Camera, settings: Settings) -> Frame:
    return renderer.render(camera, settings)


def _details(
    renderer: Renderer, camera: Camera, settings: Settings, before: Frame | None = None
) -> dict[str, npt.NDArray[np.float32]]:
    return renderer._core.details(camera, checked(renderer._choosing(settings)), depth_before(before))


def _reformation(method: tuple[Any, ...], **more: Any) -> Method:
    """Return a method other than Curved Surface Reformation."""

    def surface(renderer: Renderer, camera: Camera, settings: Settings, _: Frame | None = None) -> Frame:
        if renderer.volume is None:
            return renderer._by(method, camera, settings)
        bare = replace(settings, context=None, silhouettes=False, samples=1)
        return renderer._by(method, camera, bare, ("depth", "vessel", "value"))

    def picture(renderer: Renderer, camera: Camera, settings: Settings) -> Frame:
        return renderer._by(method, camera, settings)

    def details(
        renderer: Renderer, camera: Camera, settings: Settings, _: Frame | None = None
    ) -> dict[str, npt.NDArray[np.float32]]:
        width, height = camera.size
        found = {"sheet_gap": np.zeros((height, width), np.float32)}
        if settings.silhouettes:
            found["strength"] = renderer._core.strength(camera, checked(renderer._choosing(settings)), method)
        return found

    return Method(_own, surface, more.pop("picture", picture), details, is_filtered=False, **more)


def _picture_of_the_longest(renderer: Renderer, camera: Camera, settings: Settings) -> Frame:
    """Return the projected CPR of the longest vessel, because a file holds only one picture."""
    longest = max(renderer.tree or (), key=lambda vessel: vessel.length)
    return renderer._with_part([longest])._by(MPCPR, camera, settings)


METHODS = {
    "csr": Method(_own, _surface, _picture, _details),
    "csr-paper": Method(_paper, _surface, _picture, _details),
    # The mpCPR of a single vessel is its projected CPR.
    "cpr": _reformation(MPCPR, picture=_picture_of_the_longest, has_image_per_vessel=True),
    "mpcpr": _reformation(MPCPR),
    "cr": _reformation(cr_method()),
    "untangled": Method(_own, _surface, untangled_picture, _details, own_picture=untangled_picture),
}

#: The default methods: all methods whose frames have the pixels of the view.
USUAL = tuple(name for name, method in METHODS.items() if method.own_picture is None)


def checked_methods(names: Any) -> tuple[str, ...]:
    """Return names of methods; reject unknown, missing and repeated ones."""
    if isinstance(names, str):
        names = (names,)
    if not isinstance(names, Iterable):
        raise SettingsError("methods", repr(names), f"names of {', '.join(METHODS)}")
    found = tuple(names)
    for name in found:
        choice(SettingsError, "method", name, tuple(METHODS))
    if not found or len(set(found)) < len(found):
        shown = "no method" if not found else f"{', '.join(found)}"
        raise SettingsError("methods", shown, f"one or more different names of {', '.join(METHODS)}")
    return found


def shown_by(method: Method, renderer: Renderer, camera: Camera, settings: Settings) -> Shown:
    """Render all images that the measures need."""
    before = _before(renderer, camera, settings) if method.is_filtered else None
    frame = method.surface(renderer, camera, settings, before)
    turned = method.surface(renderer, camera.rotated(TURN, "up"), settings, frame)
    unfiltered = replace(settings, depth_filter=False)
    plain = method.surface(renderer, camera, unfiltered, before) if method.is_filtered else frame
    details = method.details(renderer, camera, settings, before)
    return Shown(
        depth=frame.depth,
        vessel=frame.vessel,
        position=frame.position,
        turned_depth=turned.depth,
        turned_vessel=turned.vessel,
        slides=slid(camera, frame.depth, turned.depth, turned.position),
        value=frame.value if frame.has("value") else None,
        plain_depth=plain.depth,
        strength=details.get("strength"),
        rim=details.get("rim"),
        sheet_gap=details.get("sheet_gap"),
    )
