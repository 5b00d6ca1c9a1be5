"""``lumencut view``: the viewer in a browser tab, served from this machine to this machine."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from lumencut.cli import options
from lumencut.cli.browser import open_or_explain
from lumencut.cli.demo import demo_scene
from lumencut.cli.mistakes import check_files, check_reading
from lumencut.cli.report import bar, detail, say, verbose_option
from lumencut.cli.scene import centerlines_of

if TYPE_CHECKING:
    from lumencut.files.centerline_file import CenterlineFile
    from lumencut.files.several_centerlines import CenterlineFiles
    from lumencut.scene.vessel_tree import VesselTree
    from lumencut.scene.volume import Volume
    from lumencut.scene.volume_file import VolumeFile
    from lumencut.viewer.arriving import ArrivingScene


@click.command(short_help="Open the viewer in a browser tab.")
@click.argument("volume", type=options.FILE, required=False)
@click.argument("centerlines", type=options.FILE, nargs=-1)
@click.option("--demo", "is_demo", is_flag=True, help="Show the CT of lumencut demo.")
@click.option(
    "--no-centerlines",
    is_flag=True,
    help="With --demo: show the CT alone, to trace its vessels in the page.",
)
@options.file_options
@click.option(
    "--port",
    type=click.IntRange(0, 65535),
    default=0,
    show_default=True,
    metavar="N",
    help="The port to listen on; 0 for any free port.",
)
@click.option("--no-browser", is_flag=True, help="Print only the address, and open no browser.")
@verbose_option
def view(
    volume: Path | None,
    centerlines: tuple[Path, ...],
    is_demo: bool,
    no_centerlines: bool,
    port: int,
    no_browser: bool,
    **chosen: Any,
) -> None:
    """Show VOLUME and CENTERLINES in a browser tab, until Ctrl-C ends it.

    VOLUME is a DICOM folder or zip archive, NIfTI, NRRD or MetaImage file; CENTERLINES one or several .vtp,
    .vtk, .mrk.json, .fcsv, .pth, .swc, .tre, .csv, .txt or .npy files, whose vessels are shown together.
    Without them the viewer opens empty, and accepts files that you drop into it.

    The page and the data are served only to browsers of this machine, under an address that contains a
    secret. The address is printed on a separate line. Nothing is sent anywhere else.

    \b
    lumencut view ct.nii.gz centerlines.vtp
    lumencut view --demo
    lumencut view --demo --no-centerlines
    lumencut view dicom/ --series 4
    lumencut view ct.nrrd LAD.mrk.json LCX.mrk.json --port 8765 --no-browser
    """  # noqa: D301 - click needs the control character itself
    if is_demo and volume is not None:
        raise click.UsageError(f"found --demo and {volume}; expected one of them: --demo has its own scan")
    if no_centerlines and not is_demo:
        raise click.UsageError("--no-centerlines without --demo does nothing; leave CENTERLINES out instead")
    check_files(volume, centerlines)
    volumes = [] if volume is None else [volume]
    check_reading(chosen, volumes, has_centerlines=bool(centerlines))
    from lumencut.viewer import page
    from lumencut.viewer.server import ViewerServer

    built = page.Page.of(page.FOLDER)
    scene = _demo(has_centerlines=not no_centerlines) if is_demo else None
    if volume is not None:
        scene = _scene(volume, centerlines, chosen)
    with ViewerServer(built, scene, port) as server:
        say(server.place.address)
        with open_or_explain(server.place, is_wanted=not no_browser):
            server.wait()


def _scene(volume: Path, centerlines: tuple[Path, ...], chosen: dict[str, Any]) -> ArrivingScene:
    """Return the scene; small files and headers are read first, so that their errors appear at once."""
    from lumencut.viewer.arriving import ArrivingScene

    lines = centerlines_of(centerlines)
    file = _opened(volume, chosen)
    detail(f"{volume}: {file.format}, {' × '.join(map(str, file.size))} voxels")
    if lines is None:
        return ArrivingScene(file)
    return ArrivingScene(file, lambda voxels: _tree(lines, voxels, chosen))


def _demo(*, has_centerlines: bool) -> ArrivingScene:
    """The scene of the demo, in memory."""
    from lumencut.scene.volume_file import held_in_memory
    from lumencut.viewer.arriving import ArrivingScene

    volume, tree, _ = demo_scene()
    file = held_in_memory(volume, "demo")
    return ArrivingScene(file, lambda _: tree) if has_centerlines else ArrivingScene(file)


def _opened(path: Path, chosen: dict[str, Any]) -> VolumeFile:
    from lumencut.files.volumes import open_volume

    with bar(f"reading {path.name}", "file") as progress:
        return open_volume(
            path,
            series=chosen["series"],
            phase=chosen["phase"],
            fill_gaps=chosen["fill_gaps"],
            resample_slices=chosen["resample_slices"],
            progress=progress,
            **options.of_zarr(chosen),
        )


def _tree(lines: CenterlineFile | CenterlineFiles, volume: Volume, chosen: dict[str, Any]) -> VesselTree:
    from lumencut.files.centerline_file import CenterlineFile

    if isinstance(lines, CenterlineFile):
        return lines.within(volume, chosen["coordinates"], chosen["unit"], reorder=chosen["reorder"])[0]
    return lines.tree(chosen["coordinates"], chosen["unit"], volume, reorder=chosen["reorder"])
