"""``lumencut info``: what a file holds, and anything unusual about it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, Literal

import click

from lumencut.cli import compare, findings
from lumencut.cli.mistakes import check_reading
from lumencut.cli.options import (
    coordinates_option,
    fill_gaps_option,
    of_zarr,
    phase_option,
    reorder_option,
    resample_slices_option,
    series_option,
    unit_option,
    zarr_options,
)
from lumencut.cli.report import FAILED, complain, say, verbose_option
from lumencut.errors import LumencutError, SeriesError

FILE = click.Path(path_type=Path)
_ONLY_IN_JSON = {"file", "name", "volume", "centerlines", "notes", "decisions", "world_from_index"}
_ONLY_IN_JSON |= {"kind", "error"}


@click.command(short_help="Show what files hold, and anything unusual.")
@click.argument("files", type=FILE, nargs=-1, metavar="FILE…")
@coordinates_option
@unit_option
@reorder_option
@series_option
@phase_option
@fill_gaps_option
@resample_slices_option
@zarr_options
@click.option(
    "--devices", "with_devices", is_flag=True, help="List the GPUs of this machine; FILE may be left out."
)
@click.option("--json", "as_json", is_flag=True, help="Print JSON; lengths in mm, world coordinates LPS.")
@verbose_option
def info(
    files: tuple[Path, ...],
    coordinates: Literal["lps", "ras"] | None,
    unit: Literal["um", "mm", "cm", "dm", "m"] | None,
    reorder: bool,
    series: str | None,
    phase: str | None,
    fill_gaps: bool,
    resample_slices: bool,
    with_devices: bool,
    as_json: bool,
    **chosen: Any,
) -> None:
    """Show what each FILE holds, what was decided and anything unusual: volumes, DICOM folders, centerlines.

    For a DICOM folder of several series, all are listed. Volumes and centerlines given together are compared,
    and a volume decides the space and unit that a centerline file leaves open. If a file cannot be read, the
    others are still shown, and the exit code is 1.
    --devices lists the GPUs first, and the device that --device auto uses: the CPU without a hardware GPU.
    """
    if not (files or with_devices):
        raise click.UsageError("Missing argument 'FILE…'.")
    _check(click.get_current_context().params, files)
    gpus = findings.of_devices() if with_devices else None
    found: dict[Path, dict[str, Any]] = {}
    # Volumes come first, because they decide the space of the centerlines.
    for path in sorted(dict.fromkeys(files), key=_holds_centerlines):
        volumes = [one for one in found.values() if one["kind"] == "volume"]
        try:
            if _holds_centerlines(path):
                found[path] = findings.of_centerlines(path, coordinates, unit, volumes, reorder=reorder)
            else:
                found[path] = findings.of_volume(
                    path,
                    series=series,
                    phase=phase,
                    fill_gaps=fill_gaps,
                    resample_slices=resample_slices,
                    **of_zarr(chosen),
                )
        except SeriesError as error:
            found[path] = findings.of_series(path, error)
            if series is not None:
                complain(error)
                found[path]["error"] = str(error)
        except LumencutError as error:
            complain(error)
            found[path] = {"file": str(path), "kind": "unreadable", "error": str(error)}
    every = [found[path] for path in files]
    volumes = [one for one in every if one["kind"] == "volume"]
    trees = [one for one in every if one["kind"] == "centerlines"]
    compared = [pair for tree in trees for pair in compare.compared(tree, volumes)]
    say(_as_json(gpus, every, compared) if as_json else _as_text(gpus, every, compared))
    if any("error" in one for one in every):
        click.get_current_context().exit(FAILED)


def _check(chosen: dict[str, Any], files: tuple[Path, ...]) -> None:
    """Reject options for kinds of files that are not given."""
    volumes = [path for path in files if not _holds_centerlines(path)]
    check_reading(chosen, volumes, has_centerlines=len(volumes) < len(files))


def _holds_centerlines(path: Path) -> bool:
    from lumencut.base.file_kinds import extensions, kind_of

    kind = kind_of(path)
    if kind is not None:
        return kind.role == "centerlines"
    return path.name.lower().endswith((*extensions("centerlines"), ".json"))


def _as_json(gpus: dict[str, Any] | None, found: list[dict[str, Any]], compared: list[dict[str, Any]]) -> str:
    public = [{key: value for key, value in one.items() if not key.startswith("_")} for one in found]
    return json.dumps((gpus or {}) | {"files": public, "compared": compared}, indent=2, allow_nan=False)


def _as_text(gpus: dict[str, Any] | None, found: list[dict[str, Any]], compared: list[dict[str, Any]]) -> str:
    blocks = []
    if gpus is not None:
        named = [
            {"file": gpu["name"]} | {key: gpu[key] for key in gpu if key != "name"} for gpu in gpus["devices"]
        ]
        blocks = [*map(_block, named), f"auto takes: {gpus['auto']}"]
    shown = [one for one in found if one["kind"] != "unreadable"]
    return "\n".join([*blocks, *map(_block, shown), *map(_block, compared)])


def _block(one: dict[str, Any]) -> str:
    """Return the file name, then one line per fact, decision and note."""
    title = one.get("file") or f"{one['centerlines']} in {one['volume']}"
    shown = {
        key: value
        for key, value in one.items()
        if not (key in _ONLY_IN_JSON or key.startswith("_") or value in (None, "", [], {}))
    }
    width = max((len(key) for key in shown), default=0)
    lines = [
        f"  {key.replace('_', ' '):<{width}}  {line}"
        for key, value in shown.items()
        for line in (_lines(value) if key != "filled_slices" else [_ranges(value)])
    ]
    decisions = [f"  > {decision}" for decision in one.get("decisions", [])]
    return "\n".join([title, *lines, *decisions, *(f"  ! {note}" for note in one["notes"])])


def _ranges(numbers: list[int]) -> str:
    """Return increasing integers as text; consecutive integers become a range."""
    starts = [n for n, number in enumerate(numbers) if n == 0 or number != numbers[n - 1] + 1]
    parts = [numbers[a:b] for a, b in zip(starts, [*starts[1:], len(numbers)], strict=True)]
    return ", ".join(str(part[0]) if len(part) == 1 else f"{part[0]} to {part[-1]}" for part in parts)


def _lines(value: Any) -> list[str]:
    """Return a value as one line, or a list as one line per item."""
    if isinstance(value, dict):
        return [str(value["shown"])]
    if isinstance(value, list) and isinstance(value[0], dict):
        return [str(one["shown"]) for one in value]
    return [_value(value)]


def _value(value: Any) -> str:
    if isinstance(value, list):
        return ("; " if isinstance(value[0], list) else ", ").join(_value(item) for item in value)
    return f"{value:.6g}" if isinstance(value, float) else str(value)
