"""``lumencut trace``: centerlines from points along vessels, from one seed, from nothing, or from a mask."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import click

from lumencut._lumencut import WRITTEN_CENTERLINES
from lumencut.cli import options
from lumencut.cli.found_vessels import check_found, found_by, found_options, found_vessels, polarity_of
from lumencut.cli.mistakes import check_reading
from lumencut.cli.options import FILE
from lumencut.cli.parameters import VECTOR
from lumencut.cli.report import bar, busy, detail, say, verbose_option
from lumencut.cli.scene import volume_of
from lumencut.cli.trace_mask import WITH_MASK, mask_options, traced_from_mask

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from lumencut.scene.vessel_tree import VesselTree
    from lumencut.scene.volume import Volume

    Points = npt.NDArray[np.float64]


@click.command(short_help="Trace centerlines: all, from points, from one seed, or from a mask.")
@click.argument("volume", type=FILE, required=False)
@click.option(
    "--point",
    type=VECTOR,
    multiple=True,
    help="A point in the vessel (mm, LPS); two or more in order along one vessel.",
)
@click.option(
    "--index",
    type=VECTOR,
    multiple=True,
    metavar="I,J,K",
    help="The same as voxel indices from 0, instead of --point.",
)
@click.option(
    "--points",
    type=FILE,
    multiple=True,
    help="A file of points: .mrk.json, .fcsv, .csv or another format of centerlines, each line of it a "
    "vessel; may be repeated.",
)
@click.option(
    "--stopper",
    type=VECTOR,
    multiple=True,
    help="A place that no vessel may pass (mm, LPS); may be repeated.",
)
@click.option(
    "--stopper-radius",
    type=click.FloatRange(min=0, min_open=True),
    default=3.0,
    show_default=True,
    metavar="MM",
    help="Radius of the forbidden region around a stopper.",
)
@click.option("--ras", is_flag=True, help="Points, seed and stoppers given here are in RAS, not LPS.")
@click.option(
    "--bridge",
    is_flag=True,
    help="Continue where no lumen is visible, as in an occlusion; marked as uncertain.",
)
@found_options
@mask_options
@click.option(
    "-o",
    "--output",
    type=FILE,
    required=True,
    help=f"The centerlines (mm, LPS): {WRITTEN_CENTERLINES}.",
)
@click.option("--preview", type=FILE, help="A picture of the result from the front, such as preview.png.")
@options.series_option
@options.phase_option
@options.fill_gaps_option
@options.resample_slices_option
@options.zarr_options
@options.device_option
@options.threads_option
@verbose_option
def trace(
    volume: Path | None,
    output: Path,
    preview: Path | None,
    bridge: bool,
    device: Literal["auto", "cpu", "gpu"],
    **chosen: Any,
) -> None:
    """Trace centerlines in VOLUME: all, those along points or from one seed, or those of a mask.

    --find finds all vessels without any point; --seed finds all branches that one point reaches. Both leave
    out doubtful vessels and report their number. Points along vessels need not be central: all --point are
    one vessel; files of --points may hold several, which join where they meet. --mask traces a mask of the
    lumen, or labels of a label map; VOLUME is optional then, and must have the grid of the mask. The points
    of the result are at most 0.5 mm apart, each with the radius of the lumen and a confidence.

    \b
    lumencut trace ct.nii.gz --point 12,-30,85 --point 8,-41,-20 -o aorta.vtp --preview aorta.png
    lumencut trace ct.nii.gz --find -o all.vtp --preview all.png
    lumencut trace ct.nii.gz --seed 12,-30,85 -o tree.vtp --preview tree.png
    lumencut trace chest.nii.gz --dark --seed 2,-160,760 -o airways.vtp --preview airways.png
    lumencut trace --mask total.nii.gz --label 52=aorta --label 65 -o lines.vtp
    lumencut trace dicom/ --points vessels.mrk.json --stopper 20,-35,40 -o lines.vtp
    """  # noqa: D301 - click needs the control character itself
    _check(volume, output, preview, {**chosen, "bridge": bridge})
    voxels = None if volume is None else volume_of(volume, chosen)
    if voxels is None or chosen["mask"] is not None:
        tree = traced_from_mask(chosen, voxels)
    elif found_by(chosen) is not None:
        tree = found_vessels(chosen, voxels)
    else:
        tree = _traced(voxels, chosen, bridge=bridge)
    from lumencut.files.centerline_writers import write_centerlines

    with busy(f"writing {output.name}"):
        write_centerlines(tree, output)
    for vessel in tree:
        detail(f"{vessel!r}{_mean('radius', vessel.radius, ' mm')}{_mean('confidence', vessel.confidence)}")
    say(f"{output}: {tree!r}, {sum(vessel.length for vessel in tree):.1f} mm")
    if not chosen["dark"]:
        _say_suggested(tree, voxels)
    if preview is not None and voxels is not None:
        _render((voxels, tree), preview, device, is_dark=chosen["dark"])


def _say_suggested(tree: VesselTree, voxels: Volume | None) -> None:
    """Report suggested names; none is written into the file."""
    from lumencut.tracing.suggested_names import suggest_names

    suggested = suggest_names(tree, voxels)
    for number, one in enumerate(suggested):
        if one.name is not None and tree[number].name is None:
            say(f"vessel {number}: {one.name}? (suggested name, not written)")
    veins = [str(number) for number, one in enumerate(suggested) if one.is_vein_or_heart]
    if veins:
        say(f"veins and heart (suggestion): vessels {', '.join(veins)}")


#: Options for points; except `ras`, they have no effect on found vessels or a mask.
_WITH_POINTS = ("point", "index", "points", "stopper", "bridge")
_WITH_FOUND = ("seed", "seed_index", "find", "smallest_radius", "doubtful")


def _check(volume: Path | None, output: Path, preview: Path | None, chosen: dict[str, Any]) -> None:
    """Reject options that contradict each other before any voxel is read."""
    has_mask = chosen["mask"] is not None
    for name in (*_WITH_POINTS, *_WITH_FOUND, "ras") if has_mask else WITH_MASK:
        if chosen[name]:
            where = "with" if has_mask else "without"
            option = f"--{name.replace('_', '-')}"
            raise click.UsageError(f"{option} {where} --mask does nothing; leave out {option}")
    check_found(chosen)
    if volume is None and not has_mask:
        raise click.UsageError("found no VOLUME; expected one, or --mask")
    if volume is None and chosen["dark"]:
        raise click.UsageError("--dark without VOLUME does nothing: a mask has no values; leave out --dark")
    if volume is None and preview is not None:
        raise click.UsageError("--preview needs VOLUME: a mask has no picture")
    found = found_by(chosen)
    if found is not None:
        _check_alone(chosen, found)
    elif not has_mask:
        _check_points(chosen)
    volumes = [] if volume is None else [volume]
    check_reading({"coordinates": None, "unit": None, **chosen}, volumes, has_centerlines=True)
    options.check_folder(output)
    if preview is not None:
        options.check_picture(preview)


def _check_alone(chosen: dict[str, Any], found: str) -> None:
    """Reject options that have no effect on the vessels found by this option."""
    for name in _WITH_POINTS:
        if chosen[name]:
            raise click.UsageError(f"--{name} with {found} does nothing; leave out one of them")
    if chosen["ras"] and chosen["seed"] is None:
        given = "--find" if chosen["find"] else "--seed-index"
        raise click.UsageError(f"--ras with {given} does nothing; leave out --ras")


def _check_points(chosen: dict[str, Any]) -> None:
    """Reject points that cannot define a vessel."""
    given = [name for name in ("point", "index", "points") if chosen[name]]
    if not given:
        raise click.UsageError(
            "found no points; expected --point, --index or --points along a vessel, --seed, or --find for all"
        )
    if {"point", "index"} <= set(given):
        raise click.UsageError(
            "found --point and --index; expected one of them, whose order is that of the vessel"
        )
    for name in ("point", "index"):
        if len(chosen[name]) == 1:
            raise click.UsageError(f"found one --{name}; expected two or more in order along the vessel")
    if chosen["ras"] and not (chosen["point"] or chosen["stopper"]):
        raise click.UsageError("--ras without --point or --stopper does nothing: files state their own space")


def _traced(voxels: Volume, chosen: dict[str, Any], *, bridge: bool) -> VesselTree:
    from lumencut.tracing.tracer import trace

    lists, names = _vessels(voxels, chosen)
    with bar("tracing", "share") as progress:
        tree = trace(
            voxels,
            lists,
            _in_lps(chosen["stopper"], chosen),
            stopper_radius=chosen["stopper_radius"],
            bridge=bridge,
            polarity=polarity_of(chosen),
            names=names,
            progress=progress,
        )
    for note in tree.notes:
        say(note)
    return tree


def _vessels(voxels: Volume, chosen: dict[str, Any]) -> tuple[list[Points], list[str | None]]:
    """Return the points of each vessel (mm, LPS), and the names of the vessels."""
    import numpy as np

    lists: list[Points] = []
    names: list[str | None] = []
    if chosen["point"]:
        lists.append(_in_lps(chosen["point"], chosen))
    if chosen["index"]:
        affine = voxels.world_from_index
        lists.append(np.array(chosen["index"]) @ affine[:3, :3].T + affine[:3, 3])
    names += [None] * len(lists)
    if chosen["points"]:
        from lumencut.files.centerlines import read_centerlines

        for vessel in read_centerlines(list(chosen["points"]), volume=voxels):
            lists.append(vessel.points)
            names.append(vessel.name)
    return lists, names


def _in_lps(points: tuple[tuple[float, ...], ...], chosen: dict[str, Any]) -> Points:
    import numpy as np

    signs = (-1.0, -1.0, 1.0) if chosen["ras"] else (1.0, 1.0, 1.0)
    return np.array(points, dtype=np.float64).reshape(-1, 3) * signs


def _mean(name: str, numbers: Points | None, unit: str = "") -> str:
    """Return the mean over all points of a vessel, as text."""
    return "" if numbers is None else f", {name} {float(numbers.mean()):.2f}{unit}"


def _render(
    scene: tuple[Volume, VesselTree], path: Path, device: Literal["auto", "cpu", "gpu"], *, is_dark: bool
) -> None:
    from lumencut.pictures.renderer import Renderer
    from lumencut.scene.focus import Focus
    from lumencut.scene.settings import Settings

    # Around dark lumens, the smallest values show where they run on.
    settings = Settings(focus=Focus(), context="minip") if is_dark else None
    with bar("rendering", "share") as progress:
        frame = Renderer(*scene, device).render(settings=settings, progress=progress)
    frame.save(path)
    say(str(path))
