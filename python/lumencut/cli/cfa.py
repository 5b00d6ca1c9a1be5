"""``lumencut cfa``: straightened vessels that show their surroundings on all sides in one picture."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from lumencut.cli import options, reformations

if TYPE_CHECKING:
    from lumencut.reformation import Reformation
    from lumencut.renderer import Renderer
    from lumencut.settings import Settings
    from lumencut.vessel import Vessel

#: The names of ``lumencut.feature_aggregation.FEATURES``; copied so that ``--help`` does not import numpy.
FEATURES = ("max", "mean", "min", "range", "share")


@click.command(short_help="Show all around vessels, straightened (CFA).")
@reformations.file_options
@reformations.output_option
@click.option(
    "--feature",
    type=click.Choice(FEATURES),
    default="max",
    show_default=True,
    help="What to show of a half circle. max: calcium and metal; min: whether the lumen is open; mean; "
    "range: how uneven the surroundings are; share: the part above --level.",
)
@click.option(
    "--radius", type=float, default=10.0, show_default=True, metavar="MM", help="The largest circle (mm)."
)
@click.option("--level", type=float, metavar="VALUE", help="--feature share counts values above this level.")
@click.option(
    "--beside",
    type=click.Choice(("cpr",)),
    help="Show the straightened CPR, CFA max and CFA min of each vessel side by side.",
)
@reformations.vessel_options
@reformations.up_option
@reformations.pixel_spacing_option
@reformations.smoothing_option
@reformations.picture_options
def cfa(beside: str | None, **given: Any) -> None:
    """Show what surrounds the vessels of CENTERLINES, straightened: curvicircular feature aggregation.

    Each pixel next to a vessel stands for the half circle around it on that side, so one picture shows all
    around the vessel. All vessels are shown side by side, each below its id and name, unless --vessel,
    --exclude or --path choose among them.

    \b
    lumencut cfa ct.nii.gz centerlines.vtp -o LAD.png --vessel LAD --radius 8
    lumencut cfa ct.nii.gz centerlines.vtp -o sheet.png --path 0,1,4 --beside cpr
    lumencut cfa ct.nii.gz centerlines.vtp -o calcium.png --feature share --level 500
    """  # noqa: D301 - click needs the control character itself
    options.check_picture(given["output"])
    chosen, settings = reformations.like(given, "cfa")
    _check(chosen, beside)
    renderer, _, vessels = reformations.read_vessels(chosen, settings, "cfa")
    if beside is None:
        feature = chosen["feature"]
        reformations.write_each(
            chosen, vessels, lambda vessel: _made(renderer, vessel, feature, chosen, settings)
        )
        return
    reformations.write_beside(
        chosen,
        vessels,
        lambda vessel, shown: _made(renderer, vessel, shown, chosen, settings),
        ("cpr", "max", "min"),
    )


def _check(chosen: dict[str, Any], beside: str | None) -> None:
    """Reject options that contradict each other before any file is read."""
    shares = beside is None and chosen["feature"] == "share"
    if shares and chosen["level"] is None:
        raise click.UsageError("--feature share needs --level, the value above which a voxel counts")
    if chosen["level"] is not None and not shares:
        raise click.UsageError("--level does nothing without --feature share; leave out --level")
    if beside is not None and chosen["output"].suffix.lower() == ".npz":
        raise click.UsageError(f"{chosen['output']} holds one picture; --beside makes three per vessel")


def _made(
    renderer: Renderer, vessel: Vessel, shown: str, chosen: dict[str, Any], settings: Settings
) -> Reformation:
    """Return the straightened CPR of a vessel, or a picture of one of its features."""
    from lumencut.feature_aggregation import cfa_of
    from lumencut.planar_reformation import cpr_of

    how: dict[str, Any] = {name: chosen[name] for name in ("pixel_spacing", "up", "smoothing")}
    how["settings"] = settings
    if shown == "cpr":
        return cpr_of(renderer, vessel, "straightened", width=2 * chosen["radius"], **how)
    return cfa_of(renderer, vessel, chosen["radius"], shown, level=chosen["level"], **how)  # type: ignore[arg-type]
