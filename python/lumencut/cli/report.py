"""Output to the user: results on stdout; errors, warnings, details and progress on stderr."""

from __future__ import annotations

import errno
import logging
import sys
import traceback
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import NoReturn

import click

from lumencut.base.mends import Told, as_option, written
from lumencut.base.signals import EndedError, ended_by_signals
from lumencut.errors import DeviceWarning, LineWarning, LumencutError, SpaceWarning, StudyWarning

#: Exit codes other than 0 and click's 2 for wrong usage.
FAILED, INCOMPLETE, INTERRUPTED = 1, 3, 130

_VERBOSE = "lumencut.verbose"
_WITH_OPTIONS = (Told, LumencutError)

#: Format of progress bars without countable steps.
_BAR = {"share": "{desc}: {percentage:3.0f}%|{bar}| {elapsed}<{remaining}"}


def _remember(ctx: click.Context, _: click.Parameter, verbose: bool) -> None:
    # A click context shares `meta` with its subcommands, so --verbose works before and after their names.
    ctx.meta[_VERBOSE] = verbose or ctx.meta.get(_VERBOSE, False)


verbose_option = click.option(
    "--verbose",
    is_flag=True,
    expose_value=False,
    is_eager=True,
    callback=_remember,
    help="Show what was read, the time of each stage, and the traceback of an error.",
)


def is_verbose() -> bool:
    """Return whether the user asked for details."""
    ctx = click.get_current_context(silent=True)
    return ctx is not None and bool(ctx.meta.get(_VERBOSE, False))


def say(text: str) -> None:
    """Print a result."""
    click.echo(text)


def inform(text: str) -> None:
    """Print additional information for the user on stderr."""
    click.echo(text, err=True)


def detail(text: str) -> None:
    """Print a detail, visible only with --verbose."""
    if is_verbose():
        click.echo(text, err=True)


def warn(text: object) -> None:
    """Print a warning in one line."""
    click.echo(f"lumencut: warning: {one_line(text)}", err=True)


def complain(text: object) -> None:
    """Print an error message in one line."""
    click.echo(f"lumencut: error: {one_line(text)}", err=True)


def timings(title: str, milliseconds: dict[str, float]) -> None:
    """Print the time of each stage, as a detail."""
    stages = ", ".join(f"{stage} {time:.1f}" for stage, time in milliseconds.items())
    detail(f"{title}: {sum(milliseconds.values()):.1f} ms ({stages})")


@contextmanager
def reported(ctx: click.Context) -> Iterator[None]:
    """Report anything that ends a command by one line and an exit code."""
    with ended_by_signals(), warnings.catch_warnings(), _log_shown():
        warnings.simplefilter("always")
        warnings.showwarning = _shown_once()
        try:
            yield
        except KeyboardInterrupt:
            click.echo("\nlumencut: interrupted", err=True)
            ctx.exit(INTERRUPTED)
        except EndedError as end:
            click.echo(f"\nlumencut: {end}", err=True)
            ctx.exit(128 + end.number)
        except (click.ClickException, click.exceptions.Exit, click.Abort):
            raise
        except LumencutError as error:
            _fail(ctx, error)
        except MemoryError:
            _fail(ctx, "not enough memory; a smaller --size or volume needs less")
        except OSError as error:
            # The reader of a pipe, such as head, closed it: click handles this case.
            if error.errno == errno.EPIPE:
                raise
            _fail(ctx, error)
        except Exception as error:
            _fail(ctx, f"unexpected {type(error).__name__}: {error}; --verbose shows where it arose")


def _fail(ctx: click.Context, error: object) -> NoReturn:
    if is_verbose() or ctx.meta.get(_VERBOSE, False):
        click.echo(traceback.format_exc(), err=True, nl=False)
    complain(error)
    ctx.exit(FAILED)


def one_line(text: object) -> str:
    """Return a message in one line; arguments of the library are written as options."""
    # File names may contain control characters for terminals.
    words = written(text, as_option).split()
    return "".join(letter if letter.isprintable() else "�" for letter in " ".join(words))


def _shown_once() -> Callable[..., None]:
    """Return a function that shows warnings; the same StudyWarning appears only once."""
    shown: set[str] = set()

    def show(message: Warning | str, category: type[Warning], *_: object) -> None:
        words = str(message)
        if not issubclass(category, (DeviceWarning, LineWarning, SpaceWarning, StudyWarning)):
            detail(f"{category.__name__}: {message}")
        elif words not in shown:
            warn(message)
        if issubclass(category, StudyWarning):
            shown.add(words)

    return show


class _Messages(logging.Handler):
    def __init__(self) -> None:
        super().__init__()
        self._once: set[str] = set()

    def emit(self, record: logging.LogRecord) -> None:
        if getattr(record, "is_said_once", False):
            if record.getMessage() in self._once:
                return
            self._once.add(record.getMessage())
        args = record.args or ()
        record.args = tuple(one_line(arg) if isinstance(arg, _WITH_OPTIONS) else arg for arg in args)
        (warn if record.levelno >= logging.WARNING else detail)(record.getMessage())


@contextmanager
def _log_shown() -> Iterator[None]:
    """Show log messages of the package while the context is open."""
    log, handler = logging.getLogger("lumencut"), _Messages()
    log.addHandler(handler)
    spread, log.propagate = log.propagate, False
    try:
        yield
    finally:
        log.removeHandler(handler)
        log.propagate = spread


@contextmanager
def busy(what: str) -> Iterator[None]:
    """Show the present activity on a terminal."""
    if not sys.stderr.isatty():
        yield
        return
    click.echo(f"{what} …", err=True, nl=False)
    try:
        yield
    finally:
        click.echo("\r\x1b[K", err=True, nl=False)


@contextmanager
def bar(label: str, unit: str) -> Iterator[Callable[[int, int], None]]:
    """Yield a function of (done, total) that moves a progress bar; it is drawn only on a terminal."""
    from tqdm import tqdm

    with tqdm(
        desc=label, unit=unit, disable=None, leave=False, delay=0.3, bar_format=_BAR.get(unit)
    ) as drawn:

        def progress(done: int, total: int) -> None:
            drawn.total = total
            drawn.update(done - drawn.n)

        yield progress
