"""The pictures next to the turning view: the picked vessel straightened, and its cross-section."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.measuring.sections import CrossSection, cross_section
from lumencut.notebook.scene import Place, Scene
from lumencut.reformations.planar_reformation import PlanarReformation, cpr
from lumencut.reformations.request import pixel_side
from lumencut.reports.section_pictures import grey_picture
from lumencut.scene.settings import Settings

Point = npt.NDArray[np.float64]
Picture = npt.NDArray[np.uint8]
Pixel = tuple[float, float]

#: One notch of the wheel turns the straightened vessel by this angle (radians), or moves the section (mm).
TURN_STEP = math.pi / 36
STEP = 0.5
#: Half width of a section (radii of the vessel), and limits of its side (mm).
_RADII, _SIDES = 4.0, (12.0, 120.0)
#: Number of pixels of a section's side, and largest number of rows of a straightened vessel.
_SECTION_PIXELS, _MOST_ROWS = 160, 512


class Linked:
    """The straightened vessel and the section of one place.

    Both are made when the place is first known; another place on the same vessel only changes the section.
    """

    def __init__(self, scene: Scene, place: Place) -> None:
        assert scene.tree is not None
        self.scene, self.place = scene, place
        self.vessel = scene.tree[place.vessel]
        self.straightened = self._straightened()
        self.section = self._section()

    def moved(self, place: Place) -> Linked:
        """Return the pictures for another place in the same scene."""
        if place.vessel != self.place.vessel:
            return Linked(self.scene, place)
        return self._changed(place, self.straightened)

    def turned(self, notches: int) -> Linked:
        """Return the vessel turned to the right by a number of notches."""
        return self._changed(self.place, self.straightened.rotated(notches * TURN_STEP))

    def scrolled(self, notches: int) -> Linked:
        """Return the pictures for a place farther along the vessel by a number of notches."""
        at = min(max(self.place.at + notches * STEP, 0.0), self.vessel.length)
        return self.moved(replace(self.place, at=at))

    def _changed(self, place: Place, straightened: PlanarReformation) -> Linked:
        other = object.__new__(Linked)
        other.scene, other.place, other.vessel = self.scene, place, self.vessel
        other.straightened = straightened
        other.section = self.section if place == self.place else other._section()
        return other

    def _straightened(self) -> PlanarReformation:
        volume = self.scene.volume
        spacing = max(pixel_side(volume), self.vessel.length / _MOST_ROWS)
        laid_out = cpr(volume, self.vessel, "straightened", pixel_spacing=spacing, device="cpu")
        assert isinstance(laid_out, PlanarReformation)
        return laid_out

    def _section(self) -> CrossSection:
        radius = _lumencut.radius_at((self.vessel.points, self.vessel.radius), self.place.at)
        side = min(max(2 * _RADII * radius, _SIDES[0]), _SIDES[1])
        return cross_section(self.scene.volume, self.vessel, self.place.at, side, side / _SECTION_PIXELS)

    def pictures(self, settings: Settings) -> dict[str, Picture]:
        """Return the pictures (H, W, 4) by name, in the window of the settings."""
        window = self.scene.window(settings)
        return {
            "straightened": grey_picture(self.straightened.value, window),
            "section": grey_picture(self.section.value, window),
        }

    def marks(self, point: Point) -> dict[str, Pixel]:
        """Return where the pictures show a point (mm, LPS): column and row, by the name of the picture."""
        _, row = self.straightened.pixel_from_world(self.vessel_point())[0]
        column, _ = self.straightened.pixel_from_world(point)[0]
        across, down = self.section.pixel_from_world(point)[0]
        return {"straightened": (float(column), float(row)), "section": (float(across), float(down))}

    def vessel_point(self) -> Point:
        """Return the point (mm, LPS) of the centerline at the place."""
        points = self.vessel.points
        along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
        return np.array([np.interp(self.place.at, along, points[:, axis]) for axis in range(3)])

    def world_from_pixel(self, name: str, pixel: Pixel) -> Point:
        """Return the point (mm, LPS) that a pixel (column, row) of one of the pictures shows."""
        if name == "straightened":
            laid_out: Point = self.straightened.world_from_pixel(pixel)[0]
            return laid_out
        height, width = self.section.value.shape
        column = min(max(round(pixel[0]), 0), width - 1)
        row = min(max(round(pixel[1]), 0), height - 1)
        point: Point = self.section.position[row, column]
        return point

    def place_at(self, name: str, pixel: Pixel) -> Place:
        """Return the place on the vessel that belongs to a pixel of one of the pictures."""
        if name == "section":
            return self.place
        row = min(max(round(pixel[1]), 0), self.straightened.size[1] - 1)
        return replace(self.place, at=float(self.straightened.arc_length[row]))
