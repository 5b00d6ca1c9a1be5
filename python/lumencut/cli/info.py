"""``lumencut info``: what a file holds, and what is odd about it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, Literal

import click

from lumencut.cli import findings
from lumencut.cli.options import series_option
from lumencut.cli.report import FAILED, complain, say, verbose_option
from lumencut.errors import LumencutError

FILE = click.Path(path_type=Path)
_CENTERLINE_ENDINGS = (".vtp", ".vtk", ".json", ".pth", ".swc", ".tre", ".csv", ".txt")


@click.command(short_help="Tell what files hold, and what is odd.")
@click.argument("files", type=FILE, nargs=-1, metavar="FILE…")
@click.option(
    "--coordinates",
    type=click.Choice(["lps", "ras"]),
    help="Space of the centerline files; default: the one they state, else lps.",
)
@series_option
@click.option(
    "--devices", "with_devices", is_flag=True, help="List the GPUs of this machine; FILE may be left out."
)
@click.option("--json", "as_json", is_flag=True, help="Print JSON; lengths in mm, world coordinates LPS.")
@verbose_option
def info(
    files: tuple[Path, ...],
    coordinates: Literal["lps", "ras"] | None,
    series: str | None,
    with_devices: bool,
    as_json: bool,
) -> None:
    """Tell what each FILE holds and what is odd about it: volumes, DICOM folders and centerlines.

    Volumes and centerlines given together are compared. A file that cannot be read does not stop the rest;
    the exit code is 1 then.
    With --devices the GPUs are listed first, and what --device auto takes: the CPU where no GPU is hardware.
    """
    if not (files or with_devices):
        raise click.UsageError("Missing argument 'FILE…'.")
    gpus = findings.of_devices() if with_devices else None
    found = [_looked_into(path, coordinates, series) for path in files]
    volumes = [one for one in found if one["kind"] == "volume"]
    trees = [one for one in found if one["kind"] == "centerlines"]
    compared = [pair for tree in trees for pair in findings.compared(tree, volumes)]
    if as_json:
        public = [{key: value for key, value in one.items() if not key.startswith("_")} for one in found]
        every = (gpus or {}) | {"files": public, "compared": compared}
        say(json.dumps(every, indent=2, allow_nan=False))
    else:
        if gpus is not None:
            for gpu in gpus["devices"]:
                say(_as_text({"file": gpu["name"]} | {key: gpu[key] for key in gpu if key != "name"}))
            say(f"auto takes: {gpus['auto']}")
        for one in (*(one for one in found if one["kind"] != "unreadable"), *compared):
            say(_as_text(one))
    if any(one["kind"] == "unreadable" for one in found):
        click.get_current_context().exit(FAILED)


def _looked_into(path: Path, coordinates: Literal["lps", "ras"] | None, series: str | None) -> dict[str, Any]:
    try:
        if path.name.lower().endswith(_CENTERLINE_ENDINGS):
            return findings.of_centerlines(path, coordinates)
        return findings.of_volume(path, series)
    except LumencutError as error:
        complain(error)
        return {"file": str(path), "kind": "unreadable", "error": str(error)}


def _as_text(one: dict[str, Any]) -> str:
    """A block: the file's name, one line per fact, one line per oddity."""
    title = one.get("file") or f"{one['centerlines']} in {one['volume']}"
    hidden = {"file", "volume", "centerlines", "notes"} | {key for key in one if key.startswith("_")}
    shown = {key: value for key, value in one.items() if key not in hidden and value is not None}
    width = max(len(key) for key in shown)
    lines = [f"  {key.replace('_', ' '):<{width}}  {_value(value)}" for key, value in shown.items()]
    return "\n".join([title, *lines, *(f"  ! {note}" for note in one["notes"])])


def _value(value: Any) -> str:
    if isinstance(value, list):
        if value and isinstance(value[0], list):
            return "; ".join(_value(row) for row in value)
        return ", ".join(_value(item) for item in value)
    return f"{value:.6g}" if isinstance(value, float) else str(value)
