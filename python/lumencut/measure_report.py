"""What was measured as a web page that needs nothing beside itself: a page of paper for each vessel."""

from __future__ import annotations

import base64
import io
import math
from collections.abc import Callable, Mapping, Sequence
from html import escape

import numpy as np

from lumencut import _lumencut
from lumencut.annotation import window_words
from lumencut.flags import Flag
from lumencut.frame import picture_as_png
from lumencut.measured_vessel import MeasuredVessel
from lumencut.planar_reformation import cpr_of
from lumencut.profile_files import NOTICE
from lumencut.profile_plot import figure_of
from lumencut.profile_sections import counts, flag_words, nearest, word_of
from lumencut.renderer import Renderer
from lumencut.section_pictures import SectionView, fitting_size
from lumencut.volume import Volume
from lumencut.window import Window

#: The width of the CPR: that of the pictures of sections, of a short vessel less, down to this share of it;
#: at most so many lengths; and within these (mm).
_LEAST, _TALLEST, _WIDTHS = 0.6, 0.4, (12.0, 90.0)

#: The most rows of pixels of the CPR, and the side of the picture of a section.
_LONGEST, _SIDE = 1600, 200

_STYLE = """
body { font: 14px/1.45 sans-serif; color: #111; background: #fff; max-width: 1000px; margin: 1em auto; }
section { break-after: page; border-bottom: 1px solid #999; padding-bottom: 1em; margin-bottom: 2em; }
section p { margin: .4em 0; }
section:last-of-type { break-after: auto; }
h1 { font-size: 20px; margin: 0 0 .2em; } h2 { font-size: 15px; margin: 1em 0 .3em; }
.notice { font-weight: bold; } .stenosis { font-size: 16px; font-weight: bold; }
table { border-collapse: collapse; } th, td { padding: .15em .8em .15em 0; text-align: right; }
th { border-bottom: 1px solid #999; font-weight: normal; color: #555; vertical-align: bottom; }
th:first-child, td:first-child, td.words, th.words { text-align: left; }
figure { display: inline-block; margin: 0 1em .6em 0; break-inside: avoid; } img { max-width: 100%; }
figcaption { font-size: 12px; color: #333; }
.pair { width: 31%; } .small { font-size: 12px; color: #444; }
@page { size: A4; margin: 12mm; }
@media print { body { margin: 0; font-size: 11px; } .plot img { max-height: 100mm; } }
@media print { section { border: 0; margin: 0; padding: 0; } }
"""

_EXPLAINED = (
    "Diameters are those of the lumen: thrombus and plaque are not lumen, so that an aneurysm may be wider. "
    "Diameter means that of a circle of the same area; ± is one standard deviation from noise and fit. "
    "A stenosis is compared with the median within 1.5 mm of each reference. "
    "Suggested places are no findings: a reader must look at them. In the pictures the contour is cyan where "
    "a section counts for what is narrowest or widest, and orange where its flags leave it out."
)


def report(
    renderer: Renderer,
    volume: Volume,
    measured: Sequence[MeasuredVessel],
    settings: Mapping[str, str],
    progress: Callable[[int, int], object] = lambda done, total: None,
) -> str:
    """Return measured vessels as HTML: pictures are part of it, and it holds no script and no address.

    Nothing of the patient stands in it but what the pictures show and how vessels are called.

    Parameters
    ----------
    renderer : Renderer
        Makes the CPR.
    volume : Volume
        Its volume.
    measured : sequence of MeasuredVessel
        The vessels, a page for each.
    settings : mapping of str to str
        What was asked for, by name, in words.
    progress : function of (done, total), optional
        Called with the number of pages that are done, and how many there are.

    Raises
    ------
    MissingPackageError
        Without matplotlib.
    """
    view = SectionView(volume, Window.from_data(volume, renderer.tree), _SIDE)
    told = {**settings, "window": window_words(view.window)}
    pages = []
    for number, one in enumerate(measured, 1):
        pages.append(_page(renderer, view, one, told))
        progress(number, len(measured))
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        f"<title>Lumencut: lumen of {len(measured)} vessels</title>\n<style>{_STYLE}</style>\n"
        "</head>\n<body>\n" + "\n".join(pages) + "\n</body>\n</html>\n"
    )


def _page(renderer: Renderer, view: SectionView, one: MeasuredVessel, settings: Mapping[str, str]) -> str:
    length = float(one.profile.arc_length[-1])
    parts = [
        "<section>",
        f"<h1>Vessel {escape(one.name)}, {length:.1f} mm</h1>",
        f'<p class="notice">{NOTICE}</p>',
    ]
    if one.stenosis is not None:
        words, doubts = one.stenosis._graded.words(), one.stenosis.doubts
        parts.append(f'<p class="stenosis">{escape(words)}</p>')
        parts += [f'<p class="doubts">{escape(doubt)}</p>' for doubt in doubts]
    if one.not_graded is not None:
        parts.append(f'<p class="stenosis">No percentage: {escape(one.not_graded)}</p>')
    if one.group is not None:
        parts.append(f"<p>Group of the field: {escape(one.group)}</p>")
    parts += [_figure(_plot(renderer, view, one), "Straightened CPR and diameter along the vessel", "plot")]
    parts += ["<h2>Places</h2>", _places(one)]
    if one.marks:
        parts += ["<h2>Sections at these places, with the contour and without</h2>", _sections(view, one)]
    parts += [f"<p>{_EXPLAINED}</p>", f'<p class="small">{escape(_told(one, settings))}</p>', "</section>"]
    return "\n".join(parts)


def _plot(renderer: Renderer, view: SectionView, one: MeasuredVessel) -> bytes:
    """The profile below the straightened vessel, which runs from left to right, as PNG."""
    profile, length = one.profile, float(one.profile.arc_length[-1])
    size = fitting_size(profile)
    # Of a short vessel less of its surroundings, so that it is not drawn flat.
    width = float(np.clip(max(_LEAST * size, min(size, _TALLEST * length)), *_WIDTHS))
    # No CPR is wider than the volume.
    width = min(width, float(np.linalg.norm(np.ptp(view.volume.corners, axis=0))) / 2)
    spacing = max(0.25, length / _LONGEST)
    made = cpr_of(renderer, one.vessel, "straightened", width=width, pixel_spacing=spacing)
    figure = figure_of([("", profile, one.marks)], np.rot90(made.image))
    content = io.BytesIO()
    software = {"Software": f"lumencut {_lumencut.__version__}"}
    figure.savefig(content, format="png", dpi=130, metadata=software)
    return content.getvalue()


def _places(one: MeasuredVessel) -> str:
    """The numbers of marked places and of the widest one as a table."""
    rows = [_row(one, mark.title, mark.arc_length) for mark in one.marks]
    widest = one.profile._core.offered_widest()
    if widest is not None:
        rows.append(_row(one, "longest diameter", widest[0]))
    if not rows:
        return "<p>No section counts: see the flags.</p>"
    head = ("arc length (mm)", "diameter ± 1 SD (mm)", "shortest (mm)", "longest (mm)", "area (mm²)")
    names = "".join(f"<th>{name}</th>" for name in head)
    return (
        f'<table><tr><th>place</th>{names}<th class="words">flags</th></tr>\n' + "\n".join(rows) + "</table>"
    )


def _row(one: MeasuredVessel, name: str, at: float) -> str:
    profile = one.profile
    number = nearest(profile, at)
    numbers = (
        f"{profile.arc_length[number]:.1f}",
        f"{profile.diameter_equivalent[number]:.2f} ± {profile.uncertainty[number]:.2f}",
        f"{profile.diameter_min[number]:.2f}",
        f"{profile.diameter_max[number]:.2f}",
        f"{profile.area[number]:.1f}",
    )
    cells = "".join(f"<td>{text}</td>" for text in numbers)
    words = ", ".join(flag_words(int(profile.flags[number]))) or "none"
    return f'<tr><td>{escape(name)}</td>{cells}<td class="words">{words}</td></tr>'


def _sections(view: SectionView, one: MeasuredVessel) -> str:
    """Pictures of the sections at marked places, each with its contour and without."""
    figures = []
    for mark in one.marks:
        number = nearest(one.profile, mark.arc_length)
        pair = [view.picture(one, number, has_contour=has_contour) for has_contour in (True, False)]
        caption = f"{mark.title} at {mark.arc_length:.1f} mm"
        figures.append(_figure(picture_as_png(np.concatenate(pair, axis=1)), caption, "pair"))
    return "\n".join(figures)


def _figure(png: bytes, caption: str, kind: str) -> str:
    encoded = base64.b64encode(png).decode("ascii")
    words = escape(caption)
    return (
        f'<figure class="{kind}"><img src="data:image/png;base64,{encoded}" alt="{words}">'
        f"<figcaption>{words}</figcaption></figure>"
    )


def _told(one: MeasuredVessel, settings: Mapping[str, str]) -> str:
    """How it was measured, in words."""
    profile = one.profile
    counted = int(counts(profile).sum())
    set_flags = {word_of(flag): int(((profile.flags & int(flag)) != 0).sum()) for flag in Flag}
    words = ", ".join(f"{word} {count}" for word, count in set_flags.items() if count) or "none"
    contrasts = np.abs(profile.levels[:, 0] - profile.levels[:, 1])
    contrast = (
        float(np.median(contrasts[np.isfinite(contrasts)])) if np.isfinite(contrasts).any() else math.nan
    )
    ratio = contrast / profile.noise if profile.noise > 0 else math.inf
    asked = "; ".join(f"{name} {value}" for name, value in settings.items())
    return (
        f"Measured by Lumencut {_lumencut.__version__}. Settings: {asked}. "
        f"FWHM of the point spread {profile.fwhm:.2f} mm, {profile.fwhm_source}. "
        f"{len(profile)} sections, of which {counted} count; flags: {words}. "
        f"Contrast to noise {ratio:.0f}, contrast {contrast:.4g} in the unit of the volume."
    )
