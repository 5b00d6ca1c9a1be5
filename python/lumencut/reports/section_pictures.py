"""Pictures of sections across a vessel with the contour of the lumen, single or on a sheet."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.measuring.measured_vessel import MeasuredVessel
from lumencut.measuring.profile import Profile
from lumencut.measuring.profile_sections import counts, flag_words, nearest
from lumencut.pictures.contact_sheet import Picture, contact_sheet
from lumencut.pictures.lettering import Sheet
from lumencut.scene.volume import Volume
from lumencut.scene.window import Window

#: Colours of contours: of sections that count, and of all others.
_COUNTED, _LEFT_OUT = (64, 220, 255, 255), (255, 150, 40, 255)
_OUTER = (255, 90, 208, 255)
#: The lumen of the line and the other one behind a flap.
_OWN_LUMEN, _OTHER_LUMEN = (90, 230, 120, 255), (178, 140, 255, 255)

#: Contours are drawn this many times larger and then scaled down, for smooth edges.
_FINER = 3


@dataclass(frozen=True, eq=False)
class SectionView:
    """How sections are shown: volume, window and size.

    Attributes
    ----------
    volume : Volume
        The volume shown.
    window : Window
        Its window.
    side : int
        The side of a picture (pixels).
    """

    volume: Volume
    window: Window
    side: int = _lumencut.SECTION_PIXELS["sheet"]

    def picture(
        self, one: MeasuredVessel, number: int, words: str = "", *, has_contour: bool = True
    ) -> Picture:
        """Return one section (H, W, 4): the measured plane, the contour, numbers with units, a scale.

        The contour is cyan if the section counts for narrowest and widest places, orange if flags exclude it;
        a dashed pink one is the outer wall; green and violet are both lumens at a flap. Without contours
        there are no numbers. `words` stand above them.
        """
        profile, spacing = one.profile, _lumencut.section_spacing(one.profile._core, self.side)
        origin, across = profile.center[number], profile.axes[number]
        steps = (np.arange(self.side) - (self.side - 1) / 2) * spacing
        places = origin + steps[:, None, None] * across[1] + steps[None, :, None] * across[0]
        value = self.volume.sample(places.reshape(-1, 3)).reshape(self.side, self.side)
        picture = grey_picture(value, self.window)
        if not has_contour:
            return _with_scale(Sheet(picture), spacing)
        contour = (profile.contour[number] - origin) @ across.T / spacing + (self.side - 1) / 2
        if np.isfinite(contour).all():
            color = _COUNTED if counts(profile)[number] else _LEFT_OUT
            picture = _with_line(picture, contour, color)
        for points, color in (
            (profile.outer_contour, _OUTER),
            (profile.own_lumen, _OWN_LUMEN),
            (profile.other_lumen, _OTHER_LUMEN),
        ):
            line = (points[number] - origin) @ across.T / spacing + (self.side - 1) / 2
            if np.isfinite(line).all():
                picture = _with_line(picture, line, color, is_dashed=color == _OUTER)
        return _labelled(picture, profile, number, words, spacing)


def sections_sheet(
    view: SectionView,
    measured: Sequence[MeasuredVessel],
    count: int,
    progress: Callable[[int, int], object] = lambda done, total: None,
) -> Picture:
    """Return sections side by side, each below the name of its vessel and its arc length.

    Of each vessel `count` sections from its first to its last and those of its marks are shown, to one scale.
    Each vessel begins a line.
    """
    pictures: list[Picture] = []
    titles, starts = [], []
    for done, one in enumerate(measured, 1):
        marked = _marked(one)
        starts.append(len(pictures))
        for number in sorted({*_even(one.profile, count), *marked}):
            pictures.append(view.picture(one, number, marked.get(number, "")))
            titles.append(f"vessel {one.name}, at {one.profile.arc_length[number]:.1f} mm")
        progress(done, len(measured))
    return contact_sheet(pictures, titles, starts)


def _even(profile: Profile, count: int) -> list[int]:
    """Return sections at equal distances along a vessel, including the first and the last."""
    wanted = np.linspace(0, len(profile) - 1, min(count, len(profile)))
    return [int(number) for number in np.unique(wanted.round())]


def _marked(one: MeasuredVessel) -> dict[int, str]:
    """Return the sections nearest to marked places, and what is marked there."""
    found: dict[int, list[str]] = {}
    for mark in one.marks:
        found.setdefault(nearest(one.profile, mark.arc_length), []).append(mark.title)
    return {number: ", ".join(titles) for number, titles in found.items()}


def grey_picture(value: npt.NDArray[np.float32], window: Window) -> Picture:
    """Return values (H, W) in a window as an RGBA picture (H, W, 4); values that are not finite are black."""
    share = (np.nan_to_num(value, nan=-np.inf) - window.level) / window.width + 0.5
    grey = (np.clip(share, 0, 1) * 255).round().astype(np.uint8)
    return np.stack([grey, grey, grey, np.full_like(grey, 255)], axis=-1)


def _with_line(
    picture: Picture, points: npt.NDArray[np.float64], color: tuple[int, ...], *, is_dashed: bool = False
) -> Picture:
    """Return a picture with a closed line through points (column and row)."""
    from PIL import Image, ImageDraw

    height, width = picture.shape[:2]
    finer = Image.new("L", (width * _FINER, height * _FINER), 0)
    path = [tuple(point) for point in (points + 0.5) * _FINER - 0.5]
    closed = [*path, *path[:2]]
    for part in zip(path[::2], path[1::2], strict=True) if is_dashed else [closed]:
        ImageDraw.Draw(finer).line(list(part), fill=255, width=_FINER + 1, joint="curve")
    drawn = np.asarray(finer.resize((width, height), Image.Resampling.BOX), np.float64)[..., None] / 255
    return (picture * (1 - drawn) + np.array(color) * drawn).round().astype(np.uint8)


def _labelled(picture: Picture, profile: Profile, number: int, words: str, spacing: float) -> Picture:
    """Return a section with its numbers in the upper left corner and a scale in the lower left corner."""
    sheet = Sheet(picture)
    short, long = profile.diameter_min[number], profile.diameter_max[number]
    lines = _wrapped(sheet, words)
    if not np.isfinite(profile.area[number]):
        lines.append("no lumen found")
    else:
        lines += [f"{profile.diameter_equivalent[number]:.2f} mm ({short:.2f} to {long:.2f})"]
    outer, lumens = profile._core.outer_at(number), profile._core.lumens_at(number)
    lines += [] if outer is None else [outer]
    lines += [] if lumens is None else _wrapped(sheet, lumens)
    lines += _wrapped(sheet, ", ".join(flag_words(int(profile.flags[number]))))
    for n, line in enumerate(lines):
        sheet.write(line, (sheet.margin, sheet.margin + n * sheet.line_height))
    return _with_scale(sheet, spacing)


def _with_scale(sheet: Sheet, spacing: float) -> Picture:
    sheet.scale_bar(spacing)
    return sheet.pixels()


def _wrapped(sheet: Sheet, words: str) -> list[str]:
    """Return words separated by commas, in lines that fit a sheet."""
    lines: list[str] = []
    for word in words.split(", ") if words else []:
        longer = f"{lines[-1]}, {word}" if lines else word
        if lines and sheet.box(longer, (sheet.margin, 0))[2] <= sheet.size[0] - sheet.margin:
            lines[-1] = longer
        else:
            lines.append(word)
    return lines
