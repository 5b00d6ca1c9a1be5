"""The profiles that colour a rim in pictures of the command line."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from lumencut.cli.vessels import shown_ids

if TYPE_CHECKING:
    from lumencut.measuring.profile import Profile
    from lumencut.measuring.stenosis import Stenosis
    from lumencut.scene.vessel_tree import VesselTree
    from lumencut.scene.volume import Volume

#: How ``lumencut measure`` measures without options, except for what a session file gives.
_USUAL = {
    **dict.fromkeys(("fwhm", "wall", "at", "reference", "method", "original", "comparison", "group")),
    "step": 0.5,
}

rim_option = click.option(
    "--measured",
    is_flag=True,
    help="Measure the vessels to show diameters, instead of showing the radii of CENTERLINES. All other "
    "values are always measured; narrowing and deviation need a session file as CENTERLINES with a marked "
    "stenosis.",
)


def rim_profiles(
    scene: tuple[Volume | None, VesselTree], chosen: dict[str, Any], value: str | None
) -> list[tuple[Profile, tuple[Stenosis, ...]]]:
    """Measure the shown vessels if a rim or map of a value needs it; return profiles and graded stenoses."""
    voxels, tree = scene
    if value is None or voxels is None or (value == "diameter" and not chosen["measured"]):
        return []
    from lumencut.cli.measure import measured_vessels

    vessels = [(str(number), tree[number]) for number in shown_ids(tree, chosen)]
    measured = measured_vessels(voxels, tree, vessels, {**_USUAL, "centerlines": chosen["centerlines"]})
    return [(one.profile, () if one.stenosis is None else (one.stenosis,)) for one in measured]
