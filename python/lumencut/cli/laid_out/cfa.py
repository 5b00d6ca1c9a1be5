"""``lumencut cfa``: its checks, and its pictures beside the straightened CPR."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

import click

from lumencut.cli import options
from lumencut.cli.laid_out import each
from lumencut.cli.report import busy, say

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from lumencut.reformations.reformation import Reformation
    from lumencut.scene.vessel import Vessel

#: `FEATURES` of `lumencut.reformations.feature_aggregation`; copied so that `--help` does not import numpy.
FEATURES = ("max", "mean", "min", "range", "share")


def show_cfa(beside: str | None, **given: Any) -> None:
    """Write one feature of vessels, or two of them beside the straightened CPR."""
    options.check_picture(given["output"])
    chosen, settings = each.like(given, "cfa")
    _check(chosen, beside)
    renderer, tree, vessels = each.read_vessels(chosen, settings, "cfa")
    asked = each.asked("cfa", chosen, settings, tree)
    if beside is None:
        each.write_each(chosen, vessels, partial(asked.of, renderer))
        return
    shown = {"cpr": asked.surface(2 * chosen["radius"])}
    shown |= {feature: replace(asked, feature=feature) for feature in ("max", "min")}
    makers = {name: partial(one.of, renderer) for name, one in shown.items()}
    _write_beside(chosen, vessels, makers)


def _check(chosen: dict[str, Any], beside: str | None) -> None:
    """Reject options that contradict each other before any file is read."""
    shares = beside is None and chosen["feature"] == "share"
    if shares and chosen["level"] is None:
        raise click.UsageError("--feature share needs --level, the value above which a voxel counts")
    if chosen["level"] is not None and not shares:
        raise click.UsageError("--level does nothing without --feature share; leave out --level")
    if beside is not None and chosen["output"].suffix.lower() == ".npz":
        raise click.UsageError(f"{chosen['output']} holds one picture; --beside makes three per vessel")


def _write_beside(
    chosen: dict[str, Any],
    vessels: list[tuple[str, Vessel]],
    makers: Mapping[str, Callable[[Vessel], Reformation]],
) -> None:
    """Make the images of each vessel by all `makers`, and write a sheet with one row per vessel."""
    from lumencut.pictures.contact_sheet import contact_sheet

    pictures, titles, all_made = [], [], []
    for title, vessel in vessels:
        for name, make in makers.items():
            made = each.made_of(f"{title} ({name})", vessel, make)
            pictures.append(made.annotated() if chosen["annotate"] else made.image)
            titles.append(f"{title}, {made.recipe.name}")
            all_made.append(made)
    with busy(f"writing {chosen['output'].name}"):
        starts = range(0, len(pictures), len(makers))
        each.write_sheet(contact_sheet(pictures, titles, starts), chosen, all_made)
    count = "1 vessel" if len(vessels) == 1 else f"{len(vessels)} vessels"
    say(f"{chosen['output']}: {', '.join(makers)} of {count}")
