"""``lumencut reading-study`` and ``reading-results``: readers compare reformations without knowing them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from lumencut.cli import options
from lumencut.cli.parameters import SIZE
from lumencut.cli.report import bar, say, verbose_option
from lumencut.cli.scene import check_scene, read_scene, scene_from
from lumencut.cli.settings import setting_options, settings_from


@click.command("reading-study", short_help="Make a blinded study in which readers compare methods.")
@options.scene_arguments
@click.option(
    "-o",
    "--output",
    type=options.FILE,
    required=True,
    metavar="FOLDER",
    help="Folder of the page and the key.",
)
@click.option(
    "--readers", type=click.IntRange(1, 1000), default=12, show_default=True, help="Number of readers."
)
@click.option(
    "--seed",
    type=click.IntRange(0, 2**31 - 1),
    default=0,
    show_default=True,
    help="Draws the order of questions and the marked places; the same seed gives the same study.",
)
@click.option(
    "--size",
    type=SIZE,
    default="512x512",
    show_default=True,
    metavar=SIZE.name,
    help="Size of each picture (pixels).",
)
@setting_options
@verbose_option
def reading_study(output: Path, readers: int, seed: int, size: tuple[int, int], **chosen: Any) -> None:
    """Make a study of VOLUME along CENTERLINES in which readers compare CSR, CPR, mpCPR and CR.

    Give readers only reading-study.html, which names no method. It asks 21 questions on the five criteria of
    the paper, in another order for each reader, and saves answers and times as a file. Keep key.json for
    lumencut reading-results.

    \b
    lumencut reading-study ct.nii.gz centerlines.vtp -o study --readers 12
    """  # noqa: D301 - click needs the control character itself
    settings = settings_from(chosen)
    files = scene_from(chosen)
    if not files.centerlines:
        raise click.UsageError("found no CENTERLINES; expected VOLUME, then CENTERLINES of several vessels")
    check_scene(files, chosen, settings)
    renderer, _ = read_scene(files, chosen)

    from lumencut.evaluation.reading_study import make_study

    with bar("reading study", "picture") as progress:
        page, key = make_study(
            renderer, output, readers=readers, seed=seed, settings=settings, size=size, progress=progress
        )
    say(f"{page}: for the readers, numbered 1 to {readers}")
    say(f"{key}: names the methods; keep it from the readers")


@click.command("reading-results", short_help="Compare the answers of a reading study.")
@click.argument("key", type=options.FILE)
@click.argument("answers", type=options.FILE, nargs=-1, required=True)
@click.option("--csv", type=options.FILE, help="Write the table as comma-separated values.")
@verbose_option
def reading_results(key: Path, answers: tuple[Path, ...], csv: Path | None) -> None:
    """Compare the ANSWERS of readers by the KEY of their study: votes, right answers and times.

    Intervals and tests treat readers as units. Without --csv the table is printed as Markdown.

    \b
    lumencut reading-results study/key.json answers/*.json
    """  # noqa: D301 - click needs the control character itself
    if csv is not None:
        options.check_folder(csv)

    from lumencut.evaluation.reading_study import study_results

    found = study_results(key, answers)
    if csv is None:
        say(found.to_markdown().rstrip("\n"))
    else:
        found.to_csv(csv)
        say(f"{csv}: {found.readers} of {found.invited} readers")
