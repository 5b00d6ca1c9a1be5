"""Measure the vessels of a phantom with the Python package: what the page must show.

The command line names the phantom, the FWHM (mm) or 0 to estimate it, and the heights of the plots. What was
measured is written to standard output as JSON.
"""

from __future__ import annotations

import json
import math
import sys
from typing import Any

from lumencut import Profile, Vessel, _lumencut, measure, phantom
from lumencut.measuring.measured_vessel import Marked, MeasuredVessel, vessels_csv, vessels_json
from lumencut.measuring.profile_plot import draw
from lumencut.measuring.profile_sections import counts, flag_words, nearest

#: Positions on the first vessel, as shares of its length.
PLACE, BEFORE, AFTER = 0.4, 0.03, 0.995
MOST_VESSELS = 2


def bounds(profile: Profile) -> list[str | None]:
    """What calcium or metal beside each section leaves open, in words."""
    both = zip(profile.diameter_calcium_excluded, profile.diameter_calcium_included, strict=True)
    return [
        f"{low:.2f} mm if brighter material is excluded, {high:.2f} mm if it is included"
        if low == low
        else None
        for low, high in both
    ]


def outer(profile: Profile) -> list[str | None]:
    """The outer walls around plaque, in words."""
    walls = zip(profile.outer_wall, profile.diameter_outer, profile.diameter_outer_uncertainty, strict=True)
    return [
        f"outer wall {mm:.1f} ± {unsure:.1f} mm" if wall == "seen" else None for wall, mm, unsure in walls
    ]


def numbers(profile: Profile) -> dict[str, Any]:
    """The numbers of a profile by the names that the page has for them."""

    def listed(values: Any) -> list[float | None]:
        return [float(value) if math.isfinite(value) else None for value in values]

    narrowest, widest = profile.narrowest(), profile._core.offered_widest()
    return {
        "arc_length": listed(profile.arc_length),
        "diameter": listed(profile.diameter_equivalent),
        "diameter_min": listed(profile.diameter_min),
        "diameter_max": listed(profile.diameter_max),
        "area": listed(profile.area),
        "uncertainty": listed(profile.uncertainty),
        "counts": counts(profile).tolist(),
        "flags": [flag_words(int(flags)) for flags in profile.flags],
        "bounds": bounds(profile),
        "flag_table": [
            {"word": word, "meaning": meaning, "screen": screen}
            for _, _, word, meaning, _, screen in _lumencut.MEASURING_FLAGS
        ],
        "center": profile.center.tolist(),
        "fwhm": profile.fwhm,
        "fwhm_source": profile.fwhm_source,
        "wall_source": profile.wall_source,
        "narrowest": None if narrowest is None else {"at": narrowest[0], "diameter": narrowest[1]},
        # The phantoms have no narrower place that is not suggested.
        "passed_over": None,
        "throat": None if profile.throat() is None else profile.throat()[0],
        "widest": None if widest is None else {"at": widest[0], "diameter": widest[1]},
        "not_suggested": list(profile.not_suggested()),
        "not_measured": [],
        "outer_stretch": profile._core.outer_stretch(),
        "outer": outer(profile),
        "flap_stretch": profile._core.flap_stretch(),
        "lumens": [profile._core.lumens_at(n) for n in range(len(profile))],
    }


def asked(profile: Profile) -> dict[str, Any]:
    """What the first vessel answers."""
    length = float(profile.arc_length[-1])
    at, before, after = (part * length for part in (PLACE, BEFORE, AFTER))
    graded = profile.stenosis(at, (before, after), "area")
    number = nearest(profile, at)
    return {
        "at": at,
        "references": [before, after],
        "percent": graded.percent,
        "words": str(graded),
        "doubts": list(graded.doubts),
        "suggested": [spot and spot._asdict() for spot in profile.suggested_references(at)],
        "diameter_at": profile.diameter_at(at),
        "number": number,
        "contour": profile.contour[number].tolist(),
        "length": profile.stretch(before, after).length,
        "straight": profile.stretch(before, after).straight,
        "tortuosity": profile.stretch(before, after).tortuosity,
        "direction": profile.direction(before, after).tolist(),
        "c_arm": str(profile.c_arm(before, after)),
        "angle": profile.angle_between((0.0, before), (after, length)),
    }


def drawn(profile: Profile, height: float) -> dict[str, Any]:
    """The layout of the pictures of a profile; the axes of its plot have 900 by `height` plot pixels."""
    from matplotlib.figure import Figure

    axes = Figure(figsize=(9, height / 100)).add_axes((0, 0, 1, 1))
    draw(axes, profile, ())
    (start, end), (low, high) = axes.get_xlim(), axes.get_ylim()
    pixels = _lumencut.SECTION_PIXELS["report"]
    width, spacing, _ = _lumencut.report_plan(profile._core, [])
    return {
        "side": _lumencut.section_spacing(profile._core, pixels) * (pixels - 1),
        "strip": [width, spacing],
        "range": [start, end, high],
        "rows": low / (low - high),
        "ticks": [[float(tick) for tick in ticks] for ticks in (axes.get_xticks(), axes.get_yticks())],
        "flags": [text.get_text() for text in reversed(axes.texts)],
    }


def report(vessel: Vessel, profile: Profile, options: dict[str, Any]) -> str:
    """The report of the first vessel, with a marked place and reference, without pictures."""
    length = float(profile.arc_length[-1])
    at, before = PLACE * length, BEFORE * length
    one = MeasuredVessel.of("0", vessel, profile, Marked(at, (before,), group="carotid"))
    places = [(mark.name, mark.arc_length, mark.is_suggestion) for mark in one.marks]
    asked = options | {"step": 0.5, "at": at, "reference": [before], "method": "nascet", "group": "carotid"}
    strip = ("QUJD", (1344, 100), length / 1344)
    page = {"measured": one.parts, "places": places, "strip": strip, "sections": ["QUJD"] * len(places)}
    return _lumencut.report_html(asked, (300.0, 700.0), [page])


def main() -> None:
    """Write it."""
    scene = getattr(phantom, sys.argv[1])()
    vessels = list(scene.tree)[:MOST_VESSELS]
    fwhm = float(sys.argv[2]) or None
    profiles = [measure(scene.volume, vessel, tree=scene.tree, fwhm=fwhm) for vessel in vessels]
    options = dict.fromkeys(("at", "reference", "method", "original", "comparison", "group")) | {"fwhm": fwhm}
    measured = [
        MeasuredVessel.of(str(n), vessel, profile, Marked())
        for n, (vessel, profile) in enumerate(zip(vessels, profiles, strict=True))
    ]
    found = {
        "profiles": [numbers(profile) for profile in profiles],
        "drawn": [drawn(*both) for both in zip(profiles, map(float, sys.argv[3:]), strict=True)],
        "asked": asked(profiles[0]),
        "csv": vessels_csv(measured),
        "json": vessels_json(options | {"step": 0.5}, measured),
        "report": report(vessels[0], profiles[0], options),
    }
    json.dump(found, sys.stdout, allow_nan=False)


if __name__ == "__main__":
    main()
