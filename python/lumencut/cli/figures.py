"""``lumencut figures``: the paper's figures from open data and phantoms."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Literal

import click

from lumencut.cli.options import device_option
from lumencut.cli.report import bar, say, verbose_option


@click.command(short_help="Make the figures and tables of the paper again.")
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path, file_okay=False),
    default="figures",
    show_default=True,
    metavar="FOLDER",
    help="Folder of the pictures and index.html.",
)
@click.option(
    "--only", metavar="N,…", help="Names of figures and tables, such as 1,5,table-2; all by default."
)
@click.option("--quick", is_flag=True, help="Smaller pictures and phantoms.")
@device_option
@verbose_option
def figures(output: Path, only: str | None, quick: bool, device: Literal["auto", "cpu", "gpu"]) -> None:
    """Make the figures and tables of the paper, by its rules and by the defaults side by side.

    The scans are the CT of the demo, which is downloaded once, and phantoms. Open index.html in FOLDER.

    \b
    lumencut figures --only 1,6 -o figures
    """  # noqa: D301 - click needs the control character itself
    from lumencut.evaluation.figures import make_figures

    start = time.perf_counter()
    names = None if only is None else [name.strip() for name in only.split(",")]
    with bar("figures", "figure") as progress:
        written = make_figures(output, names, quick=quick, device=device, progress=progress)
    say(f"{output / 'index.html'}: {len(written) - 1} pictures in {time.perf_counter() - start:.1f} s")
