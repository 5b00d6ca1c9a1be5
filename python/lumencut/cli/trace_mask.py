"""``lumencut trace --mask``: centerlines of a mask or of labels of a label map."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from lumencut.cli.found_vessels import polarity_of
from lumencut.cli.options import FILE, added
from lumencut.cli.report import bar, busy, detail, say, warn
from lumencut.errors import SettingsError

if TYPE_CHECKING:
    from lumencut.files.mask_files import MaskFile
    from lumencut.scene.vessel_tree import VesselTree
    from lumencut.scene.volume import Volume

_Command = TypeVar("_Command", bound=Callable[..., Any])

#: Options of `mask_options` that have no default and no effect without ``--mask``.
WITH_MASK = ("label", "threshold", "bridge_gaps")


def mask_options(command: _Command) -> _Command:
    """Add the options of a mask."""
    parts = (
        click.option(
            "--mask", type=FILE, metavar="FILE", help="A mask of the lumen, or a label map; also DICOM SEG."
        ),
        click.option(
            "--label",
            multiple=True,
            metavar="52[=aorta]",
            help="A value of the mask that is lumen, and the name of its vessels; may be repeated. Names in "
            "DICOM SEG and in files of 3D Slicer and TotalSegmentator are read too, and can replace their "
            "values. Default: every value except 0.",
        ),
        click.option(
            "--threshold",
            type=float,
            metavar="VALUE",
            help="Lumen has this value or more, for masks with fractional values.",
        ),
        click.option(
            "--bridge-gaps",
            type=click.FloatRange(0),
            default=0.0,
            metavar="MM",
            help="Bridge gaps between pieces up to this width by straight vessels; default: none.",
        ),
        click.option(
            "--shortest-branch",
            type=click.FloatRange(0),
            default=2.0,
            show_default=True,
            metavar="RADII",
            help="Leave out branches shorter than this number of radii of their parent.",
        ),
    )
    return added(parts, command)


def traced_from_mask(chosen: dict[str, Any], volume: Volume | None) -> VesselTree:
    """Trace the mask of the options, and report the vessels."""
    from lumencut.tracing.mask_tracing import trace_mask

    path: Path = chosen["mask"]
    with busy(f"looking into {path.name}"):
        opened = _opened(path, chosen["label"])
    if chosen["threshold"] is not None:
        if chosen["label"]:
            raise click.UsageError("--label and --threshold: a mask has either labels or a threshold")
        if opened.file.is_segmentation:
            found = f"--threshold does nothing with {path}, a segmentation"
            raise click.UsageError(f"{found}; leave out --threshold")
    with bar(f"reading {path.name}", "slice") as progress:
        mask = opened.read(progress)
    detail(f"{path}: {mask!r}")
    labels = opened.labels
    if chosen["threshold"] is not None:
        mask, labels = _above(mask, chosen["threshold"]), None
    with bar(f"tracing {path.name}", "share") as progress:
        tree = trace_mask(
            mask,
            volume,
            labels=labels,
            shortest_branch=chosen["shortest_branch"],
            bridge=chosen["bridge_gaps"],
            polarity=polarity_of(chosen),
            progress=progress,
        )
    _report(tree)
    return tree


def _opened(path: Path, words: tuple[str, ...]) -> MaskFile:
    """Return the opened mask, with the labels of the options."""
    from lumencut.files.mask_files import open_mask

    try:
        return open_mask(path, words)
    except SettingsError as error:
        raise click.UsageError(f"--label {error.found}: expected {error.expected}") from error


def _above(mask: Volume, threshold: float) -> Volume:
    from lumencut.scene.volume import Volume

    above = Volume(mask.array >= threshold, world_from_index=mask.world_from_index)
    above._patient = mask._patient
    return above


def _report(tree: VesselTree) -> None:
    length = sum(vessel.length for vessel in tree)
    say(f"{len(tree)} vessels, {length:.0f} mm")
    for gap in tree.gaps:
        place = ", ".join(f"{x:.1f}" for x in gap.points[0])
        done = "bridged" if gap.bridged else "not bridged"
        near, far = gap.vessels
        say(f"gap of {gap.width:.1f} mm between vessels {near} and {far} at {place}: {done}")
    for note in tree.notes:
        warn(note)
