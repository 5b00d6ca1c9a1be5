"""``lumencut bids``: process the participants of a BIDS data set, and write their tables, as a BIDS app."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Literal

import click

from lumencut.cli.batch import tell_ended
from lumencut.cli.options import FILE, device_option, threads_option
from lumencut.cli.report import FAILED, say, verbose_option, warn
from lumencut.cohort.job import NO_ROOM, SOME_FAILED
from lumencut.errors import FormatError

if TYPE_CHECKING:
    from lumencut.cohort.batch import Cohort

#: A copy of `lumencut.cohort.bids.SUFFIXES`, so that ``--help`` need not import numpy.
SUFFIXES = ("angio", "cta", "ct")


@click.command(short_help="Process the participants of a BIDS data set.")
@click.argument("data", type=FILE)
@click.argument("out", type=FILE)
@click.argument("level", type=click.Choice(["participant", "group"]))
@click.option(
    "--participant-label", multiple=True, metavar="LABEL", help="Process this one; may be repeated."
)
@click.option(
    "--suffix",
    multiple=True,
    default=SUFFIXES,
    show_default=True,
    help="How the names of angiographies end before .nii.gz; may be repeated.",
)
@click.option("--recipe", type=FILE, help="A TOML file that defines what to do with each study.")
@device_option
@threads_option
@verbose_option
def bids(
    data: Path,
    out: Path,
    level: str,
    participant_label: tuple[str, ...],
    suffix: tuple[str, ...],
    recipe: Path | None,
    device: Literal["auto", "cpu", "gpu"],
) -> None:
    """Process the angiographies of participants of DATA, a BIDS data set, or write the tables of all to OUT.

    "participant" processes each session of the participants, one after the other, in this process; a
    cluster runs one job for each participant. "group" writes the tables and the contact sheet of all. A
    participant or session without an angiography is reported, and has a row in the tables. The results have
    the form of lumencut batch.

    \b
    lumencut bids data derivatives/lumencut participant --participant-label 01
    lumencut bids data derivatives/lumencut group
    """  # noqa: D301 - click needs the control character itself
    from lumencut.base.paths import WRITABLE, checked_path
    from lumencut.cohort.batch import Cohort
    from lumencut.cohort.bids import read_bids
    from lumencut.cohort.layout import Layout
    from lumencut.cohort.recipe import read_cohort_recipe

    if level == "group" and participant_label:
        found = "--participant-label with group does nothing: group tables hold all participants"
        raise click.UsageError(f"{found}; leave out --participant-label")
    try:
        studies = read_bids(data, suffix, participant_label)
        how = read_cohort_recipe(recipe)
    except FormatError as error:
        raise click.UsageError(str(error)) from error
    for note in studies.notes:
        warn(note)
    for study in studies.studies:
        if study.left_out:
            say(f"{study.id}: skipped: {study.left_out}")
    cohort = Cohort(studies, how, Layout(checked_path(out, WRITABLE).absolute()))
    if level == "group":
        summary = cohort.gather()
        skipped = f", {summary.skipped} not done yet" if summary.skipped else ""
        left_out = f", {summary.left_out} without an angiography" if summary.left_out else ""
        say(f"{out}: {summary.done} done, {summary.failed} failed{skipped}{left_out}")
        failed = summary.failed
    else:
        failed = _participants(cohort, device)
    if failed:
        click.get_current_context().exit(SOME_FAILED)


def _participants(cohort: Cohort, device: Literal["auto", "cpu", "gpu"]) -> int:
    """Process the studies without results, and return how many failed."""
    from lumencut.cohort.one import do_one

    failed = 0
    for study in cohort.open_studies():
        code = do_one(study, cohort.recipe, cohort.layout, device)
        tell_ended(cohort.layout, study, code)
        if code == NO_ROOM:
            click.get_current_context().exit(FAILED)
        failed += code == SOME_FAILED
    return failed
