"""``lumencut measure``: the lumen of vessels by arc length, as a table, a plot, sections and a report."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from lumencut.cli import options
from lumencut.cli.dicom import study_options
from lumencut.cli.measure_dicom import check_dicom, study_for, write_objects
from lumencut.cli.measure_outputs import check_outputs, write_outputs
from lumencut.cli.mistakes import check_files, check_reading
from lumencut.cli.parameters import PLACES, WALL, joined_places
from lumencut.cli.report import bar, say, verbose_option, warn
from lumencut.cli.scene import read_files, scene_from
from lumencut.cli.vessels import named_vessels, path_option, shown_ids
from lumencut.errors import MeasuringError

if TYPE_CHECKING:
    from lumencut.measuring.measured_vessel import Marked, MeasuredVessel
    from lumencut.measuring.profile import Profile
    from lumencut.measuring.stenosis import Stenosis
    from lumencut.scene.vessel import Vessel
    from lumencut.scene.vessel_tree import VesselTree
    from lumencut.scene.volume import Volume
    from lumencut.viewer.session_file import SessionFile

#: `METHODS` of `lumencut.measuring.stenosis` and `GROUPS` of `lumencut.measuring.measured_vessel`; copied so
#: that `--help` does not import numpy.
METHODS, GROUPS = ("nascet", "ecst", "area"), ("carotid", "coronary")

#: How ``lumencut measure`` measures without options, except for what a session file gives.
_USUAL = {
    **dict.fromkeys(("fwhm", "wall", "at", "reference", "method", "original", "comparison", "group")),
    "step": 0.5,
}

_OF_A_PLACE = ("reference", "method", "original", "comparison", "group")


@click.command(short_help="Measure the lumen of vessels.")
@click.argument("volume", type=options.FILE)
@click.argument("centerlines", type=options.FILE, nargs=-1, required=True)
@click.option(
    "-o",
    "--output",
    type=options.FILE,
    multiple=True,
    required=True,
    help="The sections as a table (.csv) or as JSON (.json); may be repeated.",
)
@options.shown_vessel_options
@path_option
@click.option(
    "--step",
    type=click.FloatRange(min=0, min_open=True),
    default=0.5,
    show_default=True,
    metavar="MM",
    help="The largest distance between sections (mm).",
)
@click.option(
    "--fwhm",
    type=click.FloatRange(min=0, min_open=True, max=20),
    metavar="MM",
    help="Full width at half maximum of the scanner's point spread (mm); default: estimated from wide "
    "vessels, otherwise assumed, and stated which; a session file may give one.",
)
@click.option(
    "--wall",
    type=WALL,
    metavar=f"auto|off|{WALL.name}",
    default="auto",
    show_default=True,
    help="The level of the walls of vessels and its deviation, in the unit of the volume; 'auto' takes "
    "45,25 where the volume is in HU, otherwise no wall; 'off' does not distinguish walls.",
)
@click.option("--at", type=float, metavar="MM", help="The place of a stenosis: its arc length on the vessel.")
@click.option(
    "--reference",
    type=PLACES,
    metavar=PLACES.name,
    multiple=True,
    callback=joined_places,
    help="The place of the normal vessel (mm of arc length), for NASCET beyond the stenosis; or one on each "
    "side, joined by a comma or as a second --reference.",
)
@click.option(
    "--method",
    type=click.Choice(METHODS),
    help="The grading of the stenosis: by the diameter of the reference (nascet, the default), by --original "
    "(ecst), or by the area of the reference.",
)
@click.option(
    "--original", type=float, metavar="MM", help="The assumed original diameter at the stenosis, for ecst."
)
@click.option(
    "--comparison",
    type=float,
    metavar="MM",
    help="The diameter of a comparable normal vessel, such as that of the other side: a much narrower "
    "reference is a near-occlusion.",
)
@click.option(
    "--group",
    type=click.Choice(GROUPS),
    help="The kind of vessel, to name the clinical group of the stenosis.",
)
@click.option("--plot", type=options.FILE, help="Draw diameters by arc length (.png or .svg).")
@click.option(
    "--sections", type=options.FILE, help="Sections with their contours side by side, as a picture."
)
@click.option("--report", type=options.FILE, help="A report with a page for each vessel (.html).")
@click.option(
    "--dicom",
    type=options.FILE,
    metavar="FOLDER",
    help="Write DICOM objects into the scan's study: a structured report (needs lumencut[dicom]), the report "
    "as a PDF (needs lumencut[plot]) and pictures.",
)
@study_options
@options.reading_options
@verbose_option
def measure(output: tuple[Path, ...], **chosen: Any) -> None:
    """Measure the lumen of the vessels of CENTERLINES in VOLUME, in sections across them.

    All vessels are measured unless --vessel, --exclude or --path choose among them. Only a place that --at
    marks, or that a reader marked in a session file given as CENTERLINES, is called a stenosis; the narrowest
    place and the references are suggestions to check. The lumen excludes thrombus and plaque. --plot needs
    matplotlib.

    \b
    lumencut measure ct.nii.gz centerlines.vtp -o profile.csv --plot profile.png
    lumencut measure ct.nii.gz centerlines.vtp -o LAD.json --vessel LAD --sections LAD.png --report LAD.html
    lumencut measure ct.nii.gz lines.vtp -o ica.csv --path CCA,ICA --at 41 --reference 70 --group carotid
    """  # noqa: D301 - click needs the control character itself
    _check_places(chosen)
    check_outputs(output, chosen)
    check_dicom(chosen)
    files = scene_from(chosen)
    check_files(files.volume, files.centerlines)
    check_reading(chosen, [chosen["volume"]], has_centerlines=True)
    voxels, tree = read_files(files, chosen)
    if voxels is None or tree is None:
        raise click.UsageError("lumencut measure needs VOLUME and CENTERLINES")
    from lumencut.scene.placement import check_meeting

    check_meeting(voxels, tree)
    study = None if chosen["dicom"] is None else study_for(voxels, chosen)
    vessels = named_vessels(tree, chosen)
    if chosen["at"] is not None and len(vessels) > 1:
        mend = "choose one by --vessel or --path"
        raise click.UsageError(f"--at is a place on one vessel; found {len(vessels)}; {mend}")
    measured = measured_vessels(voxels, tree, vessels, chosen)
    for one in measured:
        say(f"{one.name}: {_described(one.profile)}")
        for line in one.lines:
            say(f"  {line}")
    write_outputs(voxels, tree, measured, output, chosen)
    if study is not None:
        write_objects((voxels, tree), measured, study, chosen)


def _described(profile: Profile) -> str:
    """Return a description of how a vessel was measured."""
    length = f"{len(profile)} sections over {profile.arc_length[-1]:.1f} mm"
    return f"{length}, FWHM {profile.fwhm:.2f} mm {profile.fwhm_source}"


def _check_places(chosen: dict[str, Any]) -> None:
    """Reject options of a stenosis if no place is marked, or if its method does not use them."""
    if chosen["at"] is None:
        for name in _OF_A_PLACE:
            if chosen[name] is not None:
                raise click.UsageError(f"--{name} without --at does nothing; mark the place of the stenosis")
        return
    is_graded = chosen["reference"] is not None or chosen["method"] == "ecst"
    for name in _OF_A_PLACE[1:]:
        if chosen[name] is not None and not is_graded:
            mend = "give --reference, or --method ecst with --original"
            raise click.UsageError(f"--{name} grades nothing without a reference; {mend}")


def measured_vessels(
    voxels: Volume, tree: VesselTree, vessels: Sequence[tuple[str, Vessel]], chosen: dict[str, Any]
) -> list[MeasuredVessel]:
    """Return the measured vessels, and warn of vessels that cannot be measured; fail if none can."""
    from lumencut.measuring.line_by_hand import with_line_by_hand
    from lumencut.measuring.measured_vessel import MeasuredVessel
    from lumencut.measuring.sections import measure as library
    from lumencut.tracing.suggested_names import suggest_names

    found, marked = [], _marked(chosen)
    suggested = {str(n): one.name for n, one in enumerate(suggest_names(tree))}
    session = _session(chosen)
    if session and session.contours:
        warn(f"the session has {session.contours} contour(s) by hand, which only the viewer measures")
    # Options that mark a place or state the blur take precedence over the session file.
    marks = session.marks if session and chosen["at"] is None else ()
    marks_of = {str(number): each for number, each in enumerate(marks)}
    fwhm = session.fwhm if session and chosen["fwhm"] is None else chosen["fwhm"]
    with bar("measuring", "share") as progress:
        for number, (ids, vessel) in enumerate(vessels, 1):
            try:
                part = partial(_report_share, progress, number - 1, len(vessels))
                how = {"tree": tree, "wall": chosen["wall"], "progress": part}
                profile = library(voxels, vessel, chosen["step"], fwhm, **how)
                if session and ids in session.by_hand:
                    profile = with_line_by_hand(profile, vessel, session.by_hand[ids])
                if marked.at is not None:
                    _refuse(profile, marked.at, marked)
                made = MeasuredVessel.of(ids, vessel, profile, marks_of.get(ids, marked))
                found.append(made.with_suggested_name(suggested.get(ids)))
            except MeasuringError as error:
                if number == len(vessels) and not found:
                    raise
                warn(f"vessel {ids} is not measured: {error}")
    return found


def _report_share(
    progress: Callable[[int, int], None], before: int, count: int, done: int, total: int
) -> None:
    """Report the progress over all vessels, computed from the progress of the present vessel."""
    progress(before * total + done, count * total)


def _refuse(profile: Profile, at: float, marked: Marked) -> None:
    """Reject options that cannot be graded. Marks of a session file only get a reason in the report."""
    profile.diameter_at(at)
    if marked.references or marked.method == "ecst":
        of = (marked.references or None, marked.method, marked.original)
        graded = profile.stenosis(at, *of, comparison=marked.comparison)
        if marked.group is not None:
            graded.group(marked.group)


def _session(chosen: dict[str, Any]) -> SessionFile | None:
    """Return the session file if it is the only file of CENTERLINES."""
    from lumencut.viewer.session_file import is_session_file, read_session

    files = chosen["centerlines"]
    return read_session(files[0]) if len(files) == 1 and is_session_file(files[0]) else None


def _marked(chosen: dict[str, Any]) -> Marked:
    from lumencut.measuring.measured_vessel import Marked

    return Marked(
        chosen["at"],
        chosen["reference"] or (),
        chosen["method"] or "nascet",
        chosen["original"],
        chosen["comparison"],
        chosen["group"],
    )


def rim_profiles(
    chosen: dict[str, Any], value: str | None, voxels: Volume | None, tree: VesselTree
) -> list[tuple[Profile, tuple[Stenosis, ...]]]:
    """Measure the shown vessels if a rim or map of a value needs it; return profiles and graded stenoses."""
    if value is None or voxels is None or (value == "diameter" and not chosen["measured"]):
        return []
    vessels = [(str(number), tree[number]) for number in shown_ids(tree, chosen)]
    measured = measured_vessels(voxels, tree, vessels, {**_USUAL, "centerlines": chosen["centerlines"]})
    return [(one.profile, () if one.stenosis is None else (one.stenosis,)) for one in measured]
