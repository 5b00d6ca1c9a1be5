"""The command ``lumencut``: one module per subcommand.

Nothing heavy is imported before a subcommand runs, so that ``--help`` answers at once.
"""

from __future__ import annotations

from typing import Any

import click

from lumencut.cli.batch import batch
from lumencut.cli.bids import bids
from lumencut.cli.compare_methods import compare_methods
from lumencut.cli.compare_scans import compare_scans
from lumencut.cli.convert import convert
from lumencut.cli.demo import demo
from lumencut.cli.doctor import doctor
from lumencut.cli.evaluate import evaluate
from lumencut.cli.figures import figures
from lumencut.cli.first_words import first_words
from lumencut.cli.info import info
from lumencut.cli.laid_out.reformation_table import COMMANDS
from lumencut.cli.measure import measure
from lumencut.cli.pull import pull
from lumencut.cli.push import push
from lumencut.cli.reading_study import reading_results, reading_study
from lumencut.cli.render import render
from lumencut.cli.report import reported, say, verbose_option
from lumencut.cli.settings import settings
from lumencut.cli.sheet import sheet
from lumencut.cli.summarize import summarize
from lumencut.cli.trace import trace
from lumencut.cli.turntable import turntable
from lumencut.cli.view import view

__all__ = ["main"]


class _Program(click.Group):
    """A group that reports errors in one line and leaves with the exit codes of this program."""

    def invoke(self, ctx: click.Context) -> Any:
        with reported(ctx):
            return super().invoke(ctx)


def _version(ctx: click.Context, _: click.Parameter, asked: bool) -> None:
    if asked and not ctx.resilient_parsing:
        from lumencut import __version__

        click.echo(f"lumencut {__version__}")
        ctx.exit()


@click.group(
    "lumencut",
    cls=_Program,
    invoke_without_command=True,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 110},
    epilog="Files stay on this machine unless you push them to a PACS. Lumencut is not a medical device.",
)
@click.option(
    "--version", is_flag=True, expose_value=False, is_eager=True, callback=_version, help="Show the version."
)
@verbose_option
@click.pass_context
def main(ctx: click.Context) -> None:
    """Show the lumen of all vessels of a CT or MR angiography in one freely rotatable view."""
    if ctx.invoked_subcommand is None:
        say(first_words())


ALL_COMMANDS = (
    view,
    render,
    turntable,
    compare_methods,
    *COMMANDS,
    sheet,
    evaluate,
    figures,
    reading_study,
    reading_results,
    info,
    convert,
    trace,
    measure,
    compare_scans,
    batch,
    summarize,
    bids,
    pull,
    push,
    settings,
    doctor,
    demo,
)
for _command in ALL_COMMANDS:
    main.add_command(_command)
