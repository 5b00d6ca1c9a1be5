"""The report of measured vessels: the core writes the text, this module adds the pictures."""

from __future__ import annotations

import base64
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from lumencut import _lumencut
from lumencut.measuring.measured_vessel import MeasuredVessel
from lumencut.measuring.profile_sections import nearest
from lumencut.pictures.picture_file import picture_as_png
from lumencut.pictures.renderer import Renderer
from lumencut.reformations.planar_reformation import CprRequest
from lumencut.reports.section_pictures import SectionView
from lumencut.scene.volume import Volume
from lumencut.scene.window import Window


def report(
    renderer: Renderer,
    volume: Volume,
    measured: Sequence[MeasuredVessel],
    asked: Mapping[str, Any],
    progress: Callable[[int, int], object] = lambda done, total: None,
) -> str:
    """Return a report of measured vessels as HTML; it contains its pictures, no script and no link.

    About the patient the report contains only the pictures and the names of vessels.

    Parameters
    ----------
    renderer : Renderer
        Makes the straightened CPR.
    volume : Volume
        Its volume.
    measured : sequence of MeasuredVessel
        The vessels, a page for each.
    asked : mapping
        The options of ``lumencut measure`` by name, from ``step`` to ``group``; None where one was not given.
    progress : function of (done, total), optional
        Called with the number of finished vessels, and the number of all vessels.
    """
    view = SectionView(volume, Window.from_data(volume, renderer.tree), _lumencut.SECTION_PIXELS["report"])
    pages = []
    for number, one in enumerate(measured, 1):
        pages.append(_page(renderer, view, one))
        progress(number, len(measured))
    window = (view.window.level, view.window.width)
    return _lumencut.report_html(asked, window, pages)


def _page(renderer: Renderer, view: SectionView, one: MeasuredVessel) -> dict[str, Any]:
    """Return a vessel with the pictures that its report needs."""
    places = [(mark.name, mark.arc_length, mark.is_suggestion) for mark in one.marks]
    width, spacing, sections = _lumencut.report_plan(one.profile._core, places)
    return {
        "measured": one.parts,
        "places": places,
        "strip": _strip(renderer, view, one, (width, spacing)),
        "sections": [_section(view, one, at) for at in sections],
    }


def _strip(
    renderer: Renderer, view: SectionView, one: MeasuredVessel, wished: tuple[float, float]
) -> tuple[str, tuple[int, int], float]:
    """Return the straightened vessel from left to right, its columns and rows, and its pixel side (mm)."""
    width, spacing = wished
    # A wider CPR would reach out of the volume.
    width = min(width, float(np.linalg.norm(np.ptp(view.volume.corners, axis=0))) / 2)
    made = CprRequest("straightened", width, spacing).of(renderer, one.vessel)
    picture = np.rot90(made.image)
    return _encoded(picture), (picture.shape[1], picture.shape[0]), spacing


def _section(view: SectionView, one: MeasuredVessel, at: float) -> str:
    """Return the section at an arc length (mm), once with its contour and once without."""
    number = nearest(one.profile, at)
    pair = [view.picture(one, number, has_contour=has_contour) for has_contour in (True, False)]
    return _encoded(np.concatenate(pair, axis=1))


def _encoded(picture: Any) -> str:
    return base64.b64encode(picture_as_png(picture)).decode("ascii")
