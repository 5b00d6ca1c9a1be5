"""Files that ``lumencut measure`` writes: tables, JSON, plots, sections and reports."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from lumencut.cli import options
from lumencut.cli.report import bar, busy, say

if TYPE_CHECKING:
    from lumencut.measuring.measured_vessel import MeasuredVessel
    from lumencut.scene.vessel_tree import VesselTree
    from lumencut.scene.volume import Volume

_ENDINGS = {
    "output": (".csv", ".json"),
    "plot": (".png", ".svg"),
    "report": (".html", ".htm"),
}

#: Largest number of sections per vessel and on a sheet; every vessel may have the third number.
_SECTIONS, _IN_ALL, _LEAST = 20, 240, 4

#: Largest number of vessels in a plot: each adds 4 inches to its height.
_PLOTTED = 40


def check_outputs(output: Sequence[Path], chosen: dict[str, Any]) -> None:
    """Reject outputs that cannot be written before any file is read."""
    named = [("output", path) for path in output]
    named += [(name, chosen[name]) for name in ("plot", "report") if chosen[name] is not None]
    for name, path in named:
        if path.suffix.lower() not in _ENDINGS[name]:
            found = f"{path}: found the extension {path.suffix!r}"
            raise click.UsageError(f"{found}; expected {' or '.join(_ENDINGS[name])}")
        options.check_folder(path)
    if chosen["sections"] is not None:
        _check_sheet(chosen["sections"])
    if chosen["device"] != "auto" and chosen["report"] is chosen["dicom"] is None:
        raise click.UsageError(
            "--device only affects --report and --dicom, since measuring runs on the CPU; leave out --device"
        )
    _check_twice([path for _, path in named] + [chosen["sections"]])
    if chosen["plot"] is not None:
        from lumencut.measuring.profile_plot import check_matplotlib

        check_matplotlib()


def write_outputs(
    voxels: Volume,
    tree: VesselTree,
    measured: Sequence[MeasuredVessel],
    output: Sequence[Path],
    chosen: dict[str, Any],
) -> None:
    """Write the requested outputs, and report them."""
    for path in output:
        _write_profiles(path, measured, chosen)
    if chosen["plot"] is not None:
        _write_plot(chosen["plot"], measured)
    if chosen["sections"] is not None:
        _write_sheet(chosen["sections"], voxels, tree, measured)
    if chosen["report"] is not None:
        _write_report(chosen["report"], voxels, tree, measured, chosen)


def _check_sheet(path: Path) -> None:
    if path.suffix.lower() == ".npz":
        raise click.UsageError(f"{path}: found the extension '.npz'; expected a picture format such as .png")
    options.check_picture(path)


def _check_twice(paths: Sequence[Path | None]) -> None:
    """Reject two outputs with the same file name."""
    places = [path.resolve() for path in paths if path is not None]
    twice = next((place for place in places if places.count(place) > 1), None)
    if twice is not None:
        raise click.UsageError(f"{twice} would be written twice; give each output another name")


def _write_profiles(path: Path, measured: Sequence[MeasuredVessel], chosen: dict[str, Any]) -> None:
    from lumencut.base.paths import write_text
    from lumencut.measuring.measured_vessel import vessels_csv, vessels_json

    is_table = path.suffix.lower() == ".csv"
    text = vessels_csv(measured) if is_table else vessels_json(chosen, measured)
    write_text(path, text)
    count = "1 vessel" if len(measured) == 1 else f"{len(measured)} vessels"
    say(f"{path}: {count}, {sum(len(one.profile) for one in measured)} sections")


def _write_plot(path: Path, measured: Sequence[MeasuredVessel]) -> None:
    if len(measured) > _PLOTTED:
        mend = "choose by --vessel"
        raise click.UsageError(f"{path} holds {_PLOTTED} vessels at most; found {len(measured)}; {mend}")
    from lumencut.measuring.profile_plot import figure_of, write

    with busy(f"writing {path.name}"):
        rows = [(_title(one), one.profile, one.marks) for one in measured]
        write(figure_of(rows), path)
    say(str(path))


def _title(one: MeasuredVessel) -> str:
    name = f"vessel {one.name}, {one.profile.arc_length[-1]:.1f} mm"
    lines = [] if one.stenosis is None else one.lines
    return "\n".join([name, *lines])


def _write_sheet(path: Path, voxels: Volume, tree: VesselTree, measured: Sequence[MeasuredVessel]) -> None:
    from lumencut.pictures.picture_file import save_picture
    from lumencut.reports.section_pictures import SectionView, sections_sheet
    from lumencut.scene.window import Window

    count = min(_SECTIONS, max(_LEAST, _IN_ALL // len(measured)))
    with bar("sections", "vessel") as progress:
        view = SectionView(voxels, Window.from_data(voxels, tree))
        save_picture(sections_sheet(view, measured, count, progress), path)
    say(str(path))


def _write_report(
    path: Path,
    voxels: Volume,
    tree: VesselTree,
    measured: Sequence[MeasuredVessel],
    chosen: dict[str, Any],
) -> None:
    from lumencut.base.paths import write_text
    from lumencut.pictures.renderer import Renderer
    from lumencut.reports.measure_report import report

    with bar("report", "page") as progress:
        write_text(path, report(Renderer(voxels, tree, chosen["device"]), voxels, measured, chosen, progress))
    say(str(path))
