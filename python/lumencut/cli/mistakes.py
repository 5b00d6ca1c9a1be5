"""User mistakes: volume and centerlines given in the wrong order, and options without effect.

An option for a case that may not occur in the files, such as ``--fill-gaps`` for missing DICOM slices, is not
a mistake. A switch that is off and a number of 0 ask for nothing, so they are not mistakes either.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import click

from lumencut._lumencut import SETTINGS

if TYPE_CHECKING:
    from lumencut.scene.settings import Settings
    from lumencut.scene.vessel_tree import VesselTree

_CONTEXT = tuple(name for name in SETTINGS if name.startswith("context"))
_OF_ALL = ("background", "samples", *_CONTEXT)
#: Also ``--paper`` and ``--look``: they choose settings of the cut surface, but are not settings themselves.
_CUT_SURFACE = (*(name for name in SETTINGS if name not in _OF_ALL), "paper", "look")
_DICOM = ("series", "phase", "fill_gaps", "resample_slices")
_NOTHING = (None, False, 0, ())
_VESSELS = ("vessel", "exclude", "zoom_to")
_PICTURE = (
    "window",
    "opacity",
    "silhouette_color",
    "background",
    "samples",
    "edge_samples",
    "far_rim",
    *_CONTEXT,
)


def check_files(volume: Path | None, centerlines: Sequence[Path]) -> None:
    """Reject a volume given as centerlines, and centerlines given as a volume."""
    from lumencut.base.file_kinds import kind_of

    first = None if volume is None else kind_of(volume)
    kinds = {path: kind_of(path) for path in centerlines}
    swapped = next((path for path, kind in kinds.items() if kind and kind.role == "volume"), None)
    if first is not None and first.role == "centerlines":
        found = f"{_name(first)} in {volume}"
        if swapped is not None:
            raise _wrong(f"{found} and {_name(kinds[swapped])} in {swapped}", "swap them")
        if not centerlines:
            raise _wrong(found, "name the volume before it")
        raise _wrong(f"{found} as VOLUME", "name the volume first")
    if swapped is not None:
        mend = "give a file of centerlines, or leave out CENTERLINES to show only the volume"
        raise _wrong(f"{_name(kinds[swapped])} in {swapped} as CENTERLINES", mend)
    if len(kinds) < len(centerlines):
        twice = next(path for path in centerlines if centerlines.count(path) > 1)
        raise click.UsageError(f"found {twice} twice; expected each file of CENTERLINES once")


def check_reading(chosen: dict[str, Any], volumes: Iterable[Path], *, has_centerlines: bool) -> None:
    """Reject options for reading DICOM or centerlines if no such file is given."""
    from lumencut.base.file_kinds import kind_of

    kinds = {path: kind_of(path) for path in volumes}
    if all(kind is not None and not kind.is_dicom for kind in kinds.values()):
        with_what = ", ".join(f"{path}, {_name(kind)}" for path, kind in kinds.items())
        why = f"with {with_what}" if with_what else "without VOLUME"
        _refuse(chosen, _DICOM, f"{why}: it is for DICOM series", "leave out")
    if not has_centerlines:
        why = "without CENTERLINES, which it interprets"
        _refuse(chosen, ("coordinates", "unit", "reorder"), why, "give their file, or leave out")
        _refuse(chosen, _VESSELS, "without CENTERLINES", "give their file, or leave out")


def check_options(chosen: dict[str, Any], settings: Settings, *, has_centerlines: bool) -> None:
    """Reject options whose setting has no effect together with the other settings."""
    if not has_centerlines:
        _refuse(
            chosen,
            ("window",),
            "without CENTERLINES: there is no cut surface",
            "use --context-window, or leave out",
        )
        why = "without CENTERLINES: there is no cut surface"
        _refuse(chosen, _CUT_SURFACE, why, "give CENTERLINES, or leave out")
    if not {"degrees", "views"}.intersection(chosen):
        _refuse(
            chosen, ("turning_limit",), "in one picture, which does not turn", "use turntable, or leave out"
        )
    for names, why, mend in (*_idle_context(settings), *_idle_rules(settings)):
        _refuse(chosen, names, why, f"{mend}, or leave out")


def check_measured(chosen: dict[str, Any]) -> None:
    """Reject options that only change pictures if the cut surface is measured and no picture is written."""
    _refuse(chosen, _PICTURE, "without --pictures: it changes no measure", "give --pictures, or leave out")


def check_radii(chosen: dict[str, Any], tree: VesselTree | None) -> None:
    """Reject options that need radii for a tree without radii."""
    if tree is None or any(vessel.radius is not None for vessel in tree):
        return
    why = "with centerlines without radius"
    _refuse(chosen, ("centerline_smoothing",), f"{why}, by which it smooths", "leave out")
    _refuse(chosen, ("preserve_lumen",), f"{why}, from which no wall is known", "leave out")


#: Names of settings that have no effect, the reason, and what to do instead.
_Idle: TypeAlias = tuple[tuple[str, ...], str, str]


def _idle_context(settings: Settings) -> Iterator[_Idle]:
    """Return the settings of the context that have no effect."""
    if settings.context is None:
        names = tuple(name for name in _CONTEXT if name != "context")
        yield names, "with --context none", "choose a context"
    elif settings.focus is None:
        yield ("context_from", "context_halo"), "without a focus, around which it counts", "give --focus"
    if settings.context_preview:
        yield ("context_body",), "with --context-preview, which leaves it out", "leave out --context-preview"
    if settings.context in ("minip", "average"):
        why = f"with --context {settings.context}, which is grey in its window"
        yield ("context_transfer",), why, "choose another --context"
    if settings.context in ("mip", "minip", "average"):
        why = f"with --context {settings.context}, which has no surfaces"
        yield ("context_shading",), why, "choose --context mida or dvr"
    has_differences = settings.context not in ("dvr", "mip") or settings.context_shading
    if not isinstance(settings.context_transfer, str | None) and not has_differences:
        why = f"with --context {settings.context} and control points, which have their own intensities"
        yield ("context_window",), why, "choose --context mida or a transfer function by name"


def _idle_rules(settings: Settings) -> Iterator[_Idle]:
    """Return the settings of the cut surface and its lines that have no effect."""
    if settings.focus is None:
        yield ("others_strength",), "without a focus, in which it counts", "give --focus"
    if not settings.focus_vessels:
        yield ("others_strength",), "without chosen vessels", "give --focus-vessels"
    at_jumps = ("far_rim", *(("edge_samples",) if settings.edge_samples > 1 else ()))
    if not (settings.silhouettes or settings.focus_vessels):
        names = ("silhouette_rule", "silhouette_slope", "silhouette_reach", "silhouette_color")
        yield (*names, *at_jumps), "without silhouettes", "give --silhouettes"
    if settings.silhouette_rule == "leap":
        why = "with --silhouette-rule leap, which has no slope"
        yield ("silhouette_slope",), why, "give --silhouette-rule gradient"
    else:
        why = "with --silhouette-rule gradient, which has no lines at jumps"
        yield at_jumps, why, "give --silhouette-rule leap"
    if settings.silhouette_reach is None:
        yield ("far_rim",), "without --silhouette-reach: no line fades out", "give --silhouette-reach"
    if settings.samples > 1:
        yield ("edge_samples",), "with --samples, which count everywhere", "give --samples 1"
    if not settings.depth_filter:
        yield ("zone_filter", "depth_leap"), "without the depth filter", "give --depth-filter"
    if not settings.zone_filter:
        yield ("depth_leap",), "without the zone filter", "give --zone-filter"
    if settings.rim is None:
        yield ("rim_low", "rim_high"), "without --rim, whose colours it sets", "give --rim"
    if settings.rim != "diameter":
        yield ("measured",), "without --rim diameter: other rims always measure", "give --rim diameter"
    if settings.levels == 0:
        yield ("level_distance",), "with --levels 0, which uses only the finest level", "give more levels"
    if not settings.lumen_first:
        yield ("unknown_radius",), "without the rule lumen-first", "give --lumen-first"
        if settings.level_choice == "nearest":
            why = "without the rule lumen-first and with --level-choice nearest"
            yield ("lumen_margin",), why, "give --lumen-first or --level-choice own"


def _refuse(chosen: dict[str, Any], names: Iterable[str], why: str, mend: str) -> None:
    for name in names:
        if chosen.get(name) not in _NOTHING:
            option = f"--{name.replace('_', '-')}"
            raise click.UsageError(f"{option} does nothing {why}; {mend} {option}")


def _wrong(found: str, mend: str) -> click.UsageError:
    return click.UsageError(f"found {found}; expected VOLUME, then CENTERLINES; {mend}")


def _name(kind: Any) -> str:
    return str(kind.name)
