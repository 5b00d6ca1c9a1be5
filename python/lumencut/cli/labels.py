"""Options for the labels on pictures."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from lumencut.cli.options import Command, added
from lumencut.cli.report import warn

if TYPE_CHECKING:
    from lumencut.pictures.recipe import Recipe


def label_options(command: Command) -> Command:
    """Add the options for the labels of a picture."""
    parts = (
        click.option(
            "--annotate/--no-annotate",
            default=None,
            help="Letters at the edges for the sides of the patient (R, L, A, P, S, I), the view, the window "
            "and a scale bar; default: on for .png and .dcm pictures, off for other files and turntables. "
            "Pictures below 200 pixels on a side get none.",
        ),
        click.option(
            "--vessel-names/--no-vessel-names",
            default=None,
            help="Add the names of the vessels at their ends, as far as there is room; default: off.",
        ),
    )
    return added(parts, command)


def check_labels(chosen: dict[str, Any], outputs: Iterable[Path], size: tuple[int, int]) -> None:
    """Reject labels that no output can show, and warn if the picture is too small for them."""
    from lumencut.pictures.lettering import SMALLEST_SIDE

    asked = [name for name in ("annotate", "vessel_names") if chosen[name]]
    if not asked:
        return
    option = f"--{asked[-1].replace('_', '-')}"
    if chosen["annotate"] is False:
        raise click.UsageError("--vessel-names does nothing with --no-annotate; leave out one of them")
    if asked[-1] == "vessel_names" and not chosen["centerlines"]:
        raise click.UsageError("--vessel-names needs CENTERLINES; give them, or leave out --vessel-names")
    if all(path.suffix.lower() == ".npz" for path in outputs):
        raise click.UsageError(f"{option} does nothing with .npz, which holds arrays; add a picture output")
    if min(size) < SMALLEST_SIDE:
        width, height = size
        warn(f"no labels on {width} × {height} pixels: they need {SMALLEST_SIDE} on the shorter side")


def labels_of(path: Path, chosen: dict[str, Any], recipe: Recipe | None) -> dict[str, bool]:
    """Return the label arguments of `Frame.save` for a file; a recipe adds the labels of its picture."""
    names = chosen["vessel_names"]
    annotate = chosen["annotate"]
    if annotate is None:
        usual = path.suffix.lower() in (".png", ".dcm") if recipe is None else recipe.annotate
        annotate = usual or bool(names)
    if names is None:
        names = recipe is not None and recipe.vessel_names
    return {"annotate": annotate, "vessel_names": annotate and names}
