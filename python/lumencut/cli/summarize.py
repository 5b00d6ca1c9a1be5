"""``lumencut summarize``: how measures are distributed over a cohort, and how two runs of it agree."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import click

from lumencut.cli.options import FILE, check_folder
from lumencut.cli.report import say, verbose_option

#: The number of failure reasons to list, the most frequent first.
_REASONS = 10


@click.command(short_help="Show distributions over a cohort, or the agreement of two runs.")
@click.argument("out", type=FILE)
@click.argument("second", type=FILE, required=False)
@click.option("-o", "--output", type=FILE, help="Also write the table (.csv).")
@click.option("--plot", type=FILE, help="Bland-Altman plots of two runs (.png or .svg).")
@verbose_option
def summarize(out: Path, second: Path | None, output: Path | None, plot: Path | None) -> None:
    """Show how the measures of OUT, a folder that lumencut batch wrote, are distributed over its vessels.

    With SECOND, another run or reader of the same studies, show how both agree: the mean difference, its 95 %
    confidence interval, and the limits of agreement. Vessels match by name or number, sections if they are at
    most 1 mm apart. --plot needs matplotlib.

    \b
    lumencut summarize results
    lumencut summarize reader-a reader-b -o agreement.csv --plot agreement.png
    """  # noqa: D301 - click needs the control character itself
    _check(second, output, plot)
    if second is None:
        _print_states(out)
        from lumencut.cohort.distributions import COLUMNS, distributions

        _print([COLUMNS, *(one.row for one in distributions(out))], output)
        return
    from lumencut.cohort import agreement

    found = agreement.agreements(out, second)
    if not found:
        raise click.UsageError(f"{out} and {second} have no vessel in common; name two runs of one cohort")
    _print([agreement.COLUMNS, *(one.row for one in found)], output)
    if plot is not None:
        from lumencut.cohort.agreement_plot import write_plot

        write_plot(found, plot)
        say(str(plot))


def _check(second: Path | None, output: Path | None, plot: Path | None) -> None:
    """Reject outputs that cannot be written before any file is read."""
    if plot is not None and second is None:
        raise click.UsageError("--plot without SECOND does nothing; give SECOND, or leave out --plot")
    for path, endings in ((output, (".csv",)), (plot, (".png", ".svg"))):
        if path is None:
            continue
        if path.suffix.lower() not in endings:
            found = f"{path}: found the extension {path.suffix!r}"
            raise click.UsageError(f"{found}; expected {' or '.join(endings)}")
        check_folder(path)


def _print_states(out: Path) -> None:
    from lumencut.cohort.distributions import states_of

    states, reasons = states_of(out)
    say(", ".join(f"{count} {state}" for state, count in sorted(states.items())))
    for reason, count in reasons.most_common(_REASONS):
        say(f"  {count} × {reason}")


def _print(rows: Sequence[Sequence[str]], output: Path | None) -> None:
    """Print rows as columns of equal width; also write them to a file if requested."""
    widths = [max(len(row[n]) for row in rows) for n in range(len(rows[0]))]
    for row in rows:
        say("  ".join(word.ljust(width) for word, width in zip(row, widths, strict=True)).rstrip())
    if output is not None:
        from lumencut.base.csv_cells import written
        from lumencut.base.paths import write_text

        write_text(output, written(rows))
        say(str(output))
