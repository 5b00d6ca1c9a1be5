"""The state of a notebook view; it is immutable, so a failed change has no effect."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut.errors import LumencutError, TracingError, VesselTreeError
from lumencut.notebook.first_view import FirstView
from lumencut.notebook.gestures import sampled
from lumencut.notebook.linked import Linked
from lumencut.notebook.scene import Pick, Place, Scene
from lumencut.notebook.tracing import ClickedVessels
from lumencut.pictures.frame import Frame
from lumencut.scene.camera import Camera
from lumencut.scene.settings import Settings
from lumencut.scene.vessel_names import id_or_name
from lumencut.scene.vessel_tree import VesselTree

Point = npt.NDArray[np.float64]
Progress = Callable[[int, int], object]
Pixel = tuple[float, float]

_MOST_POINTS = 200


@dataclass(frozen=True)
class Shown:
    """A scene, its view, and the picked place.

    Attributes
    ----------
    scene : Scene
        The volume with its vessels.
    seen : Scene
        The displayed scene: the complete one, or only the volume while vessels are traced and drawn as lines.
    camera, settings : Camera, Settings
        The view.
    has_names, is_linked : bool
        Whether to show the names of the vessels, and the pictures next to the view.
    tracing : ClickedVessels or None
        The vessels traced by clicks; None if clicks pick vessels.
    picked : tuple of 3 floats, or None
        The cross-hair (mm, LPS).
    place : Place or None
        The picked vessel and the place on it.
    linked : Linked or None
        The pictures next to the view.
    """

    scene: Scene
    seen: Scene
    camera: Camera
    settings: Settings
    has_names: bool
    is_linked: bool
    tracing: ClickedVessels | None = None
    picked: tuple[float, float, float] | None = None
    place: Place | None = None
    linked: Linked | None = None

    @classmethod
    def first(cls, view: FirstView, *, is_traced: bool, is_linked: bool, has_names: bool) -> Shown:
        """Return the initial state."""
        scene = view.scene
        tracing = ClickedVessels(scene.volume, scene.tree) if is_traced else None
        seen = scene.with_tree(None) if is_traced else scene
        return cls(scene, seen, view.camera, view.settings, has_names, is_linked, tracing)

    @property
    def vessel(self) -> int | None:
        """The id of the picked vessel."""
        return None if self.place is None else self.place.vessel

    @property
    def pivot(self) -> Point:
        """The point (mm, LPS) about which the view turns."""
        return self.camera.center if self.picked is None else np.array(self.picked)

    def frame(self, images: Iterable[str] | None = ("image",), progress: Progress | None = None) -> Frame:
        """Return the view with these images; None means all."""
        return self.seen.renderer.render(self.camera, self.settings, images=images, progress=progress)

    def moving(self, share: float, progress: Progress) -> Frame:
        """Return the view while it moves, with a share of its pixels along each side."""
        camera = self.camera if share == 1 else sampled(self.camera, share)
        return self.seen.moving(camera, self.settings, progress)

    def with_volume(self, volume: Any, tree: VesselTree | None) -> Shown:
        """Return the state for another scene; the view stays if the scene is in the same place."""
        scene = Scene(volume, tree, self.scene.device)
        lies_alike = np.array_equal(scene.volume.corners, self.scene.volume.corners)
        camera = self.camera if lies_alike else Camera.anterior(scene.renderer.scene, self.camera.size)
        tracing = None if self.tracing is None else ClickedVessels(scene.volume, tree)
        seen = scene if tracing is None else scene.with_tree(None)
        plain = replace(self, picked=None, place=None, linked=None)
        return replace(plain, scene=scene, seen=seen, camera=camera, tracing=tracing)

    def with_tree(self, tree: VesselTree | None) -> Shown:
        """Return the state for another tree of the same volume; the picked place is looked up in it."""
        if tree is self.scene.tree:
            return self
        scene = self.scene.with_tree(tree)
        seen = scene if self.tracing is None else self.seen
        other = replace(self, scene=scene, seen=seen, place=None, linked=None)
        return other if self.picked is None else other.with_pick(other.scene.at(np.array(self.picked), 1.0))

    def with_pick(self, pick: Pick) -> Shown:
        """Return the state with the cross-hair moved and the vessel there picked, if there is one."""
        place = pick.place
        if place is None and self.place is not None:
            place = self.scene.nearest(self.place.vessel, pick.point)
        x, y, z = (float(value) for value in pick.point)
        return replace(self, picked=(x, y, z))._at(place)

    def _at(self, place: Place | None) -> Shown:
        """The picked vessel, and its pictures if possible."""
        if place is None or not self.is_linked:
            return replace(self, place=place, linked=None)
        try:
            linked = Linked(self.scene, place) if self.linked is None else self.linked.moved(place)
        except LumencutError:
            # Even a vessel that cannot be straightened, such as one without length, can be picked.
            return replace(self, place=place, linked=None)
        return replace(self, place=place, linked=linked)

    def with_linked(self, linked: Linked) -> Shown:
        """Return the state with other pictures next to the view; the cross-hair follows the place."""
        if linked.place == self.place:
            return replace(self, linked=linked)
        x, y, z = (float(value) for value in linked.vessel_point())
        return replace(self, linked=linked, place=linked.place, picked=(x, y, z))

    def with_vessel(self, vessel: int | None) -> Shown:
        """Return the state with another picked vessel: at the place near the cross-hair, or in its middle."""
        if vessel is None:
            return replace(self, place=None, linked=None)
        assert self.scene.tree is not None
        points = self.scene.tree[vessel].points
        near = points[len(points) // 2] if self.picked is None else np.array(self.picked)
        other = self._at(self.scene.nearest(vessel, near))
        if self.picked is not None:
            return other
        x, y, z = (float(value) for value in near)
        return replace(other, picked=(x, y, z))

    def vessel_id(self, word: int | str) -> int:
        """Return the id of a vessel from its id or its name.

        Raises
        ------
        VesselTreeError
            For a vessel that is not in the tree.
        """
        tree = self.scene.tree
        if tree is None:
            raise VesselTreeError("vessel of the notebook", repr(word), "a tree, which show was not given")
        return tree.ids(id_or_name(tree, word) if isinstance(word, str) else word)[0]

    def assigned(self, name: str, value: Any) -> Shown:
        """Return the state with another value of a trait."""
        if name == "tree":
            if self.tracing is None:
                return self.with_tree(value)
            tracing = ClickedVessels(self.scene.volume, value)
            return replace(self, tracing=tracing).with_tree(value)
        if name == "vessel":
            return self.with_vessel(value)
        if name != "picked":
            return replace(self, **{name: value})
        if value is None:
            return replace(self, picked=None, place=None, linked=None)
        return self.with_pick(self.scene.at(np.array(value), self.camera.pixel_spacing))

    def traced(self, point: Point) -> Shown:
        """Return the state with one more point of a traced vessel.

        Raises
        ------
        TracingError
            If no lumen leads to the point.
        """
        if self.tracing is None:
            raise TracingError("point", "a view that picks", "one that traces", "use show(…, trace=True)")
        self.tracing.add(point)
        x, y, z = (float(value) for value in point)
        return replace(self, picked=(x, y, z)).retraced()

    def retraced(self) -> Shown:
        """Return the state with the vessels that the points define."""
        return self if self.tracing is None else self.with_tree(self.tracing.tree())

    def linked_pictures(self) -> dict[str, npt.NDArray[np.uint8]]:
        """Return the pictures next to the view (H, W, 4), by name; empty without a picked vessel."""
        return {} if self.linked is None else self.linked.pictures(self.settings)

    def state(self) -> dict[str, Any]:
        """Return the lines over the pictures, and the text below them."""
        marks = {} if self.linked is None or self.picked is None else self.linked.marks(np.array(self.picked))
        return {
            "size": list(self.camera.size),
            "cross": self._pixels([] if self.picked is None else [np.array(self.picked)]),
            "points": self._pixels([] if self.tracing is None else self.tracing.points),
            "lines": self._lines(),
            "marks": {name: list(pixel) for name, pixel in marks.items()},
            "words": self._words(),
            "traces": self.tracing is not None,
        }

    def _pixels(self, points: Iterable[Point]) -> list[list[float]]:
        """Column and row of points (mm, LPS)."""
        listed = list(points)
        return self.camera.project(np.array(listed))[:, :2].round(2).tolist() if listed else []

    def _lines(self) -> list[list[list[float]]]:
        """Return the vessels as lines over the picture while they are traced."""
        if self.tracing is None:
            return []
        return [
            self._pixels(vessel.points[:: max(len(vessel) // _MOST_POINTS, 1)])
            for vessel in self.scene.tree or ()
        ]

    def _words(self) -> str:
        """Return picked vessel, place and value as text."""
        if self.picked is None:
            return ""
        value = float(self.scene.volume.sample(np.array([self.picked]))[0])
        words = [", ".join(f"{coordinate:.1f}" for coordinate in self.picked) + " mm (LPS)"]
        words += [f"value {value:.5g}"] if np.isfinite(value) else ["outside the volume"]
        if self.place is not None and self.scene.tree is not None:
            name = self.scene.tree[self.place.vessel].name or f"vessel {self.place.vessel}"
            words.insert(0, f"{name} at {self.place.at:.1f} mm")
        return " · ".join(words)
