"""``lumencut sheet``: one page of a whole tree."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from lumencut.cli import options
from lumencut.cli.mistakes import check_files, check_reading
from lumencut.cli.report import bar, say, verbose_option
from lumencut.cli.scene import read_files, scene_from


@click.command(short_help="Write one page that shows a whole tree.")
@click.argument("volume", type=options.FILE)
@click.argument("centerlines", type=options.FILE, nargs=-1, required=True)
@click.option(
    "-o", "--output", type=options.FILE, required=True, help="The page: .pdf, .png, or .html with text."
)
@click.option("--vessel", metavar="NAME|ID", multiple=True, help="A vessel with a row; may be repeated.")
@options.reading_options
@verbose_option
def sheet(volume: Path, centerlines: tuple[Path, ...], output: Path, **chosen: Any) -> None:
    """Show the tree of CENTERLINES in VOLUME on one page, and its vessels along their length.

    Each vessel has a straightened CPR that always cuts the narrowest side, a lumen map and its diameters.
    They share one axis of arc length, with the same scale for all vessels. Red lines mark suggested places.
    Without --vessel, the 12 longest vessels have a row. Needs matplotlib: pip install "lumencut[plot]".

    \b
    lumencut sheet ct.nii.gz lines.vtp -o sheet.pdf
    """  # noqa: D301 - click needs the control character itself
    from lumencut.reports.vessel_sheet import sheet as write_sheet
    from lumencut.scene.vessel_names import id_or_name

    check_files(volume, centerlines)
    check_reading(chosen, [volume], has_centerlines=True)
    options.check_folder(output)
    files = scene_from({**chosen, "volume": volume, "centerlines": centerlines})
    voxels, tree = read_files(files, {})
    assert tree is not None
    vessels = [id_or_name(tree, word) for word in chosen["vessel"]] or None
    with bar(f"writing {output.name}", "vessel") as progress:
        findings = write_sheet(
            voxels, tree, output, vessels=vessels, device=chosen["device"], progress=progress
        )
    for line in findings:
        say(line)
    say(str(output))
