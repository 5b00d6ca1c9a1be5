"""``--seed`` of ``lumencut trace`` and ``lumencut render``: all branches that one point reaches."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeVar

import click

from lumencut.cli.options import added
from lumencut.cli.parameters import VECTOR
from lumencut.cli.report import bar, say, warn

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from lumencut.vessel_tree import VesselTree
    from lumencut.volume import Volume

_Command = TypeVar("_Command", bound=Callable[..., Any])

#: The options of `seed_options` that do nothing without a seed.
WITH_SEED = ("smallest_radius", "doubtful")


def seed_options(command: _Command) -> _Command:
    """Add the options of a seed."""
    parts = (
        click.option("--seed", type=VECTOR, help="A point in a vessel (mm, LPS): trace all that it reaches."),
        click.option(
            "--seed-index",
            type=VECTOR,
            metavar="I,J,K",
            help="The same as indices of voxels, from 0, in place of --seed.",
        ),
        click.option(
            "--smallest-radius",
            type=click.FloatRange(0),
            metavar="MM",
            help="Branches of a seed end where they are narrower from there on; default: 1.",
        ),
        click.option(
            "--doubtful",
            is_flag=True,
            help="Keep the branches of a seed that are not sure; they are counted in any case.",
        ),
    )
    return added(parts, command)


def has_seed(chosen: dict[str, Any]) -> bool:
    """Tell whether a seed is given."""
    return chosen.get("seed") is not None or chosen.get("seed_index") is not None


def check_seed(chosen: dict[str, Any]) -> None:
    """Refuse options of a seed that contradict each other or do nothing."""
    if chosen["seed"] is not None and chosen["seed_index"] is not None:
        raise click.UsageError("found --seed and --seed-index; expected one of them")
    if not has_seed(chosen):
        for name in WITH_SEED:
            if chosen[name]:
                raise click.UsageError(
                    f"--{name.replace('_', '-')} without --seed does nothing; leave it out"
                )


def traced_from_seed(chosen: dict[str, Any], voxels: Volume) -> VesselTree:
    """Trace what the seed reaches, and say what is doubtful."""
    from lumencut.seed_tracing import trace_from
    from lumencut.vessel_tree import VesselTree

    smallest = {} if chosen["smallest_radius"] is None else {"smallest_radius": chosen["smallest_radius"]}
    with bar("tracing", "share") as told:
        tree = trace_from(voxels, _place(chosen, voxels), **smallest, progress=told)
    for note in tree.notes:
        warn(note)
    if not len(tree.doubtful):
        return tree
    length = sum(vessel.length for vessel in tree.doubtful)
    kept = "kept" if chosen["doubtful"] else "left out; --doubtful keeps them"
    say(
        f"doubtful: {len(tree.doubtful)} branches of {length:.0f} mm beside {len(tree)} that are sure; {kept}"
    )
    return VesselTree([*tree, *tree.doubtful]) if chosen["doubtful"] else tree


def _place(chosen: dict[str, Any], voxels: Volume) -> npt.NDArray[np.float64]:
    """The seed (mm, LPS)."""
    import numpy as np

    if chosen["seed"] is None:
        affine = voxels.world_from_index
        return np.asarray(affine[:3, :3] @ chosen["seed_index"] + affine[:3, 3])
    return np.array(chosen["seed"]) * ((-1.0, -1.0, 1.0) if chosen["ras"] else (1.0, 1.0, 1.0))
