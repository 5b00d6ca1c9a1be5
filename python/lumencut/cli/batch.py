"""``lumencut batch``: process many studies of a manifest, each in its own process."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from lumencut.cli.batch_progress import batch_progress
from lumencut.cli.options import FILE, device_option
from lumencut.cli.parameters import BYTES, Quantity
from lumencut.cli.report import complain, say, verbose_option, warn
from lumencut.cohort.job import SOME_FAILED
from lumencut.errors import FormatError

if TYPE_CHECKING:
    _Type = click.ParamType[Any]

    from lumencut.cohort.layout import Layout
    from lumencut.cohort.manifest import Manifest, Study
    from lumencut.cohort.recipe import CohortRecipe
else:
    _Type = click.ParamType

_TIMES = {"": 1, "s": 1, "min": 60, "h": 3600}


class _Part(_Type):
    """A part and the number of all parts, such as 3/40."""

    name = "K/N"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[int, int]:
        """Return the number of the part and the number of all parts."""
        if not isinstance(value, str):
            return tuple(value)
        found = re.fullmatch(r"(\d+)/(\d+)", value)
        if found is None or not 1 <= int(found[1]) <= int(found[2]):
            self.fail(f"{value!r} is not of the form K/N with K from 1 to N, such as 3/40", param, ctx)
        return int(found[1]), int(found[2])


@click.command(short_help="Process many studies, and write tables of all.")
@click.argument("manifest")
@click.option("-o", "--output", type=FILE, help="The folder of the results; created if missing.")
@click.option("--recipe", type=FILE, help="A TOML file that defines what to do with each study.")
@click.option(
    "--centerlines", metavar="PATTERN", help="The pattern of centerlines, if MANIFEST is a pattern."
)
@click.option("--mask", metavar="PATTERN", help="The same for masks of the lumen.")
@click.option("--points", metavar="PATTERN", help="The same for files of points along vessels.")
@click.option("--seeds", metavar="PATTERN", help="The same for files of seeds.")
@click.option(
    "--check", is_flag=True, help="List studies that will fail, by headers and sizes; process none."
)
@click.option("--jobs", type=click.IntRange(1, 1024), default=1, show_default=True, metavar="N",
              help="How many studies to process at once.")  # fmt: skip
@click.option("--shard", type=_Part(), help="Process one part of N; parts may run at the same time.")
@click.option(
    "--retry", type=click.Choice(["failed", "all"]), help="Process these again, even if nothing has changed."
)
@click.option("--threads", type=click.IntRange(1, 1024), metavar="N",
              help="Threads per study; default: a fair share of the cores.")  # fmt: skip
@click.option("--memory", type=Quantity("SIZE", BYTES, "8GB"), help="Memory limit per study.")
@click.option("--time-limit", type=Quantity("TIME", _TIMES, "90min"), default="1h", show_default=True,
              help="Time limit per study; 0 for no limit.")  # fmt: skip
@click.option("--dask", metavar="ADDRESS", help="Run on the workers of this dask scheduler.")
@click.option(
    "--slurm",
    metavar="NAME=VALUE,…",
    help="Run in --jobs jobs of SLURM, such as partition=long,memory=8GB,walltime=24:00:00,cores=2.",
)
@click.option("--parquet", is_flag=True, help="Write the tables as Parquet too; needs pyarrow.")
@click.option("--one", metavar="ID", help="Process only this study, in this process.")
@device_option
@verbose_option
def batch(manifest: str, output: Path | None, **chosen: Any) -> None:
    """Process each study of MANIFEST in its own process, and write tables of all.

    MANIFEST is a table (.csv or .tsv) with the columns id and volume, and centerlines, mask, points or seeds
    if a study has them; without them Lumencut finds its vessels. MANIFEST may also be a pattern such as
    'scans/{id}.nii.gz'. Without --recipe, Lumencut writes the tree, renders one picture from the front, and
    measures all vessels. Completed studies are skipped: to continue a batch that was interrupted, give the
    same command again. The exit code is 0 if all studies succeed, and 3 if some fail.

    \b
    lumencut batch studies.csv --check
    lumencut batch studies.csv -o results --jobs 4
    lumencut batch 'scans/{id}.nii.gz' --mask 'masks/{id}.nii.gz' -o results --time-limit 20min --memory 8GB
    lumencut batch studies.csv -o results --shard 3/40
    lumencut batch studies.csv -o results --slurm partition=long,memory=8GB --jobs 20
    """  # noqa: D301 - click needs the control character itself
    from lumencut.cohort.recipe import read_cohort_recipe

    sources = {name: chosen.pop(name) for name in ("centerlines", "mask", "points", "seeds")}
    given = {name: pattern for name, pattern in sources.items() if pattern is not None}
    try:
        found = _manifest(manifest, given)
        recipe = read_cohort_recipe(chosen["recipe"])
    except FormatError as error:
        # Mistakes in a manifest or recipe are reported as usage errors.
        raise click.UsageError(str(error)) from error
    if chosen.pop("check"):
        _refuse(chosen, "--check", (*_OF_ALL, "one"))
        _check(found, recipe, chosen["memory"])
        return
    if output is None:
        raise click.UsageError("Missing option '-o' / '--output'.")
    one = chosen.pop("one")
    if one is not None:
        _refuse(chosen, "--one", _OF_ALL)
        _one(found, recipe, output, one, chosen)
        return
    for note in found.notes:
        warn(note)
    _all(manifest, output, given, chosen)


_OF_ALL = ("shard", "retry", "dask", "slurm", "parquet")


def _refuse(chosen: dict[str, Any], beside: str, names: Sequence[str]) -> None:
    """Reject options that have no effect together with another option."""
    for name in names:
        if chosen.get(name):
            raise click.UsageError(f"--{name} with {beside} does nothing; leave out --{name}")


def _manifest(manifest: str, sources: dict[str, str]) -> Manifest:
    from lumencut.cohort.manifest import read_manifest

    return read_manifest(manifest, **sources)


def _one(found: Manifest, recipe: CohortRecipe, output: Path, study_id: str, chosen: dict[str, Any]) -> None:
    """Process one study in this process."""
    from lumencut.cohort.layout import Layout
    from lumencut.cohort.one import do_one, limit_memory
    from lumencut.cohort.parent import end_with_parent

    end_with_parent()
    limit_memory(None if chosen["memory"] is None else int(chosen["memory"]))
    if chosen["threads"] is not None:
        from lumencut.base.threads import set_threads

        set_threads(chosen["threads"])
    try:
        study = found.study(study_id)
    except FormatError as error:
        raise click.UsageError(str(error)) from error
    layout = Layout(output.absolute())
    code = do_one(study, recipe, layout, chosen["device"])
    tell_ended(layout, study, code)
    click.get_current_context().exit(code)


def tell_ended(layout: Layout, study: Study, code: int) -> None:
    """Report how a study ended, with the reason if it failed."""
    from lumencut.cohort.job import DONE
    from lumencut.cohort.record import read_record

    record = read_record(layout.failure(study)) if code == SOME_FAILED else None
    if record is not None:
        complain(f"{study.id}: {record.reason}")
    elif code == DONE:
        say(f"{study.id}: done")


def _check(found: Manifest, recipe: CohortRecipe, memory: float | None) -> None:
    """List the studies that will fail and those that only the run can decide, and count both."""
    from lumencut.cohort.checking import verdict_of

    for note in found.notes:
        warn(note)
    failing = unsure = 0
    for study in found.studies:
        verdict = verdict_of(study, recipe.reading, None if memory is None else int(memory))
        failing += bool(verdict.trouble)
        unsure += bool(verdict.unsure)
        for words in (verdict.trouble, *verdict.unsure):
            if words:
                say(f"{study.id}: {words}")
    more = f", of {unsure} only the run can decide" if unsure else ""
    say(f"{len(found.studies)} studies, {failing} will fail{more}")
    if failing:
        click.get_current_context().exit(SOME_FAILED)


def _all(manifest: str, output: Path, sources: dict[str, str], chosen: dict[str, Any]) -> None:
    """Process all studies, and show the progress."""
    from lumencut.cohort.batch import batch as library

    memory, seconds = chosen.pop("memory"), chosen.pop("time_limit")
    with batch_progress() as progress:
        summary = library(
            manifest,
            output,
            **{**chosen, "shard": chosen["shard"] or (1, 1)},
            memory=None if memory is None else int(memory),
            time_limit=seconds or None,
            sources=sources,
            progress=progress,
        )
    skipped = f", {summary.skipped} not done yet" if summary.skipped else ""
    say(f"{output}: {summary.done} done, {summary.failed} failed{skipped}; {summary.worked} of them now")
    if summary.failed:
        click.get_current_context().exit(SOME_FAILED)
