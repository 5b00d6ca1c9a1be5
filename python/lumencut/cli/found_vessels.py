"""``--seed`` and ``--find`` of ``lumencut trace`` and ``lumencut render``: vessels found in the scan."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeVar

import click

from lumencut._lumencut import SMALLEST_RADIUS
from lumencut.cli.options import added
from lumencut.cli.parameters import VECTOR
from lumencut.cli.report import bar, detail, say

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from lumencut.scene.polarity import Polarity
    from lumencut.scene.vessel_tree import VesselTree
    from lumencut.scene.volume import Volume

_Command = TypeVar("_Command", bound=Callable[..., Any])

#: Options of `found_options` that have no effect without a seed or `--find`.
WITH_FOUND = ("smallest_radius", "doubtful")


#: Chooses lumens that are darker than the tissue around them.
dark_option = click.option(
    "--dark",
    is_flag=True,
    help="Trace lumens that are darker than the tissue around them, such as airways and bile ducts.",
)


def polarity_of(chosen: dict[str, Any]) -> Polarity:
    """Return the polarity that --dark chooses."""
    return "dark" if chosen["dark"] else "bright"


def found_options(command: _Command) -> _Command:
    """Add the options for finding vessels in the scan, with or without a seed."""
    parts = (
        click.option(
            "--seed", type=VECTOR, help="A point in a vessel (mm, LPS): find all vessels connected to it."
        ),
        click.option(
            "--seed-index",
            type=VECTOR,
            metavar="I,J,K",
            help="The same as voxel indices from 0, instead of --seed.",
        ),
        click.option("--find", is_flag=True, help="Find all vessels, without any point."),
        click.option(
            "--smallest-radius",
            type=click.FloatRange(0),
            metavar="MM",
            help=f"Vessels of --seed and --find end where they become narrower; default: {SMALLEST_RADIUS}.",
        ),
        click.option(
            "--doubtful",
            is_flag=True,
            help="Keep the uncertain vessels of --seed and --find; they are counted in any case.",
        ),
        dark_option,
    )
    return added(parts, command)


def found_by(chosen: dict[str, Any]) -> str | None:
    """Return the option that asks to find vessels in the scan, if there is one."""
    if chosen.get("find"):
        return "--find"
    has_seed = chosen.get("seed") is not None or chosen.get("seed_index") is not None
    return "--seed" if has_seed else None


def check_found(chosen: dict[str, Any], alone: tuple[str, ...] = WITH_FOUND) -> None:
    """Reject options for finding vessels that contradict each other or, for ``alone``, have no effect."""
    seeds = [name for name in ("seed", "seed_index") if chosen[name] is not None]
    given = [f"--{name.replace('_', '-')}" for name in seeds] + ["--find"] * chosen["find"]
    if len(given) > 1:
        raise click.UsageError(f"found {' and '.join(given)}; expected only one of them")
    if chosen.get("all_parts") and not chosen["find"]:
        raise click.UsageError("--all-parts without --find does nothing; leave out --all-parts")
    if not given:
        for name in alone:
            if chosen[name]:
                option = f"--{name.replace('_', '-')}"
                raise click.UsageError(f"{option} without --seed or --find does nothing; leave out {option}")


def shown_vessels(chosen: dict[str, Any], voxels: Volume) -> VesselTree:
    """Find the vessels of a picture; by default only those of the most important part are shown."""
    from lumencut.scene.vessel_tree import VesselTree

    tree = found_vessels(chosen, voxels)
    if chosen.get("all_parts") or chosen["doubtful"] or len(tree.parts) < 2:
        return tree
    say(f"shown: the most important of {len(tree.parts)} parts; --all-parts shows them all")
    return VesselTree([tree[vessel] for vessel in tree.parts[0]])


def found_vessels(chosen: dict[str, Any], voxels: Volume) -> VesselTree:
    """Find the requested vessels, and report the doubtful ones."""
    from lumencut.scene.vessel_tree import VesselTree

    tree = _tree(chosen, voxels)
    if not len(tree.doubtful):
        return tree
    length = sum(vessel.length for vessel in tree.doubtful)
    kept = "kept" if chosen["doubtful"] else "left out; --doubtful keeps them"
    doubtful = f"{len(tree.doubtful)} {_several(chosen)} of {length:.0f} mm"
    say(f"doubtful: {doubtful}, in addition to {len(tree)} certain ones; {kept}")
    return VesselTree([*tree, *tree.doubtful]) if chosen["doubtful"] else tree


def _tree(chosen: dict[str, Any], voxels: Volume) -> VesselTree:
    """Return the vessels, and a report on them."""
    from lumencut.tracing.seed_tracing import trace_from
    from lumencut.tracing.vessel_finding import find_vessels

    smallest, polarity = chosen["smallest_radius"], polarity_of(chosen)
    with bar(f"finding {_several(chosen)}", "share") as progress:
        if chosen["find"]:
            tree = find_vessels(voxels, smallest_radius=smallest, polarity=polarity, progress=progress)
        else:
            tree = trace_from(
                voxels,
                _place(chosen, voxels),
                smallest_radius=smallest,
                polarity=polarity,
                progress=progress,
            )
    for note in tree.notes:
        say(note)
    for number, part in enumerate(tree.parts):
        length = sum(tree[vessel].length for vessel in part)
        detail(f"part {number}: {len(part)} {_several(chosen)} of {length:.0f} mm")
    return tree


def _several(chosen: dict[str, Any]) -> str:
    return "dark lumens" if chosen["dark"] else "vessels"


def _place(chosen: dict[str, Any], voxels: Volume) -> npt.NDArray[np.float64]:
    """Return the point of the seed (mm, LPS)."""
    import numpy as np

    if chosen["seed"] is None:
        affine = voxels.world_from_index
        return np.asarray(affine[:3, :3] @ chosen["seed_index"] + affine[:3, 3])
    return np.array(chosen["seed"]) * ((-1.0, -1.0, 1.0) if chosen["ras"] else (1.0, 1.0, 1.0))
