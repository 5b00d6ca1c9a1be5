"""The scenes that the figures show; each is made when the first figure needs it."""

from __future__ import annotations

import functools
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal

import numpy as np

from lumencut import phantom
from lumencut.demo import demo_scene
from lumencut.pictures.renderer import Renderer
from lumencut.scene.camera import Camera
from lumencut.scene.focus import Focus
from lumencut.scene.settings import Settings
from lumencut.scene.vessel import Vessel
from lumencut.scene.vessel_tree import VesselTree

if TYPE_CHECKING:
    from lumencut.evaluation.figures.drawing import Picture
    from lumencut.pictures.frame import Frame

#: The two sets of rules that figures compare, with their headings.
RULES = {"paper": "the paper's rules", "default": "the defaults"}
#: The cut surface would start this far inside the walls, so it is nowhere.
_NO_CUT = Focus(margin=-1000.0, fade=0.0)
#: Scale of the phantoms of figures 7 and 8; quick figures use the smaller one.
_SCALES = {False: 0.5, True: 0.25}


def settings_of(rule: str, **changes: object) -> Settings:
    """Return the settings of a set of rules, changed."""
    return replace(Settings.paper() if rule == "paper" else Settings(), **changes)  # type: ignore[arg-type]


@dataclass(frozen=True)
class Scenes:
    """The scenes of the figures.

    Parameters
    ----------
    quick : bool
        Make smaller phantoms and pictures.
    device : {"auto", "cpu", "gpu"}
        The device of their renderers.
    """

    quick: bool = False
    device: Literal["auto", "cpu", "gpu"] = "auto"

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of a picture (pixels)."""
        return (256, 256) if self.quick else (512, 512)

    @property
    def tall_size(self) -> tuple[int, int]:
        """Width and height of a picture of the legs (pixels)."""
        side = self.size[0]
        return (side // 2, side * 5 // 4)

    @functools.cached_property
    def _demo(self) -> tuple[Renderer, bool]:
        volume, tree, error = demo_scene()
        return Renderer(volume, tree, self.device), error is None

    @property
    def aorta(self) -> Renderer:
        """The CT of the demo: a bifurcation of the aorta; a phantom if it is unavailable."""
        return self._demo[0]

    @property
    def has_ct(self) -> bool:
        """Whether :attr:`aorta` is the CT of the demo."""
        return self._demo[1]

    @functools.cached_property
    def legs(self) -> Renderer:
        """The vessels of the legs with a cross-over bypass."""
        made = phantom.runoff(scale=_SCALES[self.quick])
        return Renderer(made.volume, made.tree, self.device)

    @functools.cached_property
    def neck(self) -> Renderer:
        """The vessels of the neck."""
        made = phantom.cervical(scale=_SCALES[self.quick])
        return Renderer(made.volume, made.tree, self.device)

    @functools.cached_property
    def trefoil(self) -> Renderer:
        """A trefoil knot."""
        made = phantom.trefoil()
        return Renderer(made.volume, made.tree, self.device)

    def anterior(self, renderer: Renderer) -> Camera:
        """Return the view from the front."""
        return Camera.anterior(renderer.scene, self.size)

    def wireframe(self, renderer: Renderer, camera: Camera, context: Literal["dvr"] | None) -> Picture:
        """Return the vessel walls as a wireframe over the context, without the cut surface."""
        settings = Settings(
            focus=_NO_CUT, context=context, context_from="whole", silhouettes=False, tree="wireframe"
        )
        return renderer.render(camera, settings, images=["image"]).image[..., :3]

    def surface(self, renderer: Renderer, camera: Camera, settings: Settings) -> Frame:
        """Return the cut surface with all that the figures show of it."""
        return renderer.cut_surface(camera, settings, images=("depth", "cost", "level", "piece"))


def uneven_line() -> VesselTree:
    """Return a line with a bend and small waves, which turn its surface to and fro."""
    along = np.linspace(-40, 40, 161)
    waves = 0.8 * np.sin(1.7 * along) + 0.5 * np.sin(0.63 * along + 1)
    depth = 6 * np.sin(along / 18) + 1.2 * np.cos(1.3 * along)
    return VesselTree([Vessel(np.column_stack([along, depth, 6 * np.cos(along / 25) + waves]), 1.5)])
