"""``lumencut cpr``: its checks, the view of its mode tangential, and its volume."""

from __future__ import annotations

import math
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from lumencut._lumencut import DEFAULTS, WRITTEN_VOLUMES
from lumencut.base.file_kinds import written_kind
from lumencut.cli import options
from lumencut.cli.dicom import study_of
from lumencut.cli.laid_out import each
from lumencut.cli.like import typed
from lumencut.cli.report import busy, detail, say, warn

if TYPE_CHECKING:
    from collections.abc import Callable

    from lumencut.pictures.renderer import Renderer
    from lumencut.reformations.reformation import Reformation
    from lumencut.reformations.tangential import TangentialReformation
    from lumencut.scene.settings import Settings
    from lumencut.scene.vessel import Vessel
    from lumencut.scene.volume import Volume

#: The modes of ``lumencut.cpr``; copied so that ``--help`` does not import numpy.
MODES = ("projected", "stretched", "straightened", "tangential")

_TANGENTIAL = "tangential"

#: Options of the tangential mode only, and options of the other modes only.
_OWN, _OTHERS = ("view", "size"), ("width", "angle", "roll")

_SIZE = (768, 768)


def show_cpr(volume_out: Path | None, **given: Any) -> None:
    """Write the pictures of vessels laid out, and the volume of one."""
    _check_view(given)
    _check_outputs(given["output"], volume_out)
    chosen, settings = each.like({**given, "camera": None}, "cpr")
    has_series = volume_out is not None and not volume_out.suffix
    renderer, tree, vessels = each.read_vessels(chosen, settings, "cpr", has_series=has_series)
    if volume_out is not None:
        each.check_single(vessels, volume_out)
    make: Callable[[Vessel], Reformation] = partial(_tangential, renderer, chosen, settings)
    if chosen["mode"] != _TANGENTIAL:
        make = partial(each.asked("cpr", chosen, settings, tree).of, renderer)
    each.write_each(chosen, vessels, make)
    if volume_out is not None and renderer.volume is not None:
        _write_volume(volume_out, renderer.volume, vessels[0][1], chosen)
    detail(f"device: {renderer.device}")


def _check_view(chosen: dict[str, Any]) -> None:
    """Reject options that have no effect in the chosen mode."""
    is_own = chosen["mode"] == _TANGENTIAL
    idle = [name for name in (_OTHERS if is_own else _OWN) if name in typed(chosen)]
    if idle:
        mend = f"leave out --{idle[0]}, or choose {'another mode' if is_own else f'--mode {_TANGENTIAL}'}"
        raise click.UsageError(f"--{idle[0]} does nothing with --mode {chosen['mode']}; {mend}")


def _check_outputs(output: Path, volume_out: Path | None) -> None:
    """Reject outputs that cannot be written before any file is read."""
    options.check_picture(output)
    if volume_out is None:
        return
    if volume_out.suffix and written_kind(volume_out, "volume") is None:
        found = f"{volume_out}: found the extension {volume_out.suffix!r}"
        raise click.UsageError(f"{found}; expected {WRITTEN_VOLUMES}, or none for a DICOM series")
    options.check_folder(volume_out)


def _tangential(
    renderer: Renderer, chosen: dict[str, Any], settings: Settings, vessel: Vessel
) -> TangentialReformation:
    """Return the tangential CPR in the view of --like, or in that of the options, fitted to the vessel."""
    from lumencut.pictures.reformation_recipe import recipe_camera
    from lumencut.reformations.tangential import TangentialRequest
    from lumencut.scene.vessel_tree import VesselTree

    if chosen["camera"] is not None and not {*_OWN, "up", "pixel_spacing"} & typed(chosen).keys():
        camera = recipe_camera(chosen["camera"])
    else:
        view = {"view": chosen["view"] or "anterior", "size": chosen["size"] or _SIZE}
        view["up"] = chosen["up"] if "up" in typed(chosen) else None
        placed = {**chosen, **view, "rotate": 0.0, "tilt": 0.0, "zoom": 1.0, "center": None}
        camera = options.placed(options.view_from(placed), VesselTree([vessel]), placed)
    asked = TangentialRequest(camera, smoothing=chosen["smoothing"], settings=settings)
    return asked.of(renderer, vessel)


def _write_volume(path: Path, voxels: Volume, vessel: Vessel, chosen: dict[str, Any]) -> None:
    """Write the sections across a vessel as a volume, by default with the voxel size of the scan."""
    from lumencut.reformations.straightening import straightened_volume

    with busy(f"writing {path.name}"):
        made = straightened_volume(
            voxels,
            vessel,
            chosen["width"] or DEFAULTS["cpr.width"],
            chosen["pixel_spacing"],
            math.radians(chosen["angle"]),
            chosen["up"],
            chosen["smoothing"],
        )
        made.save(path, **({} if path.suffix else study_of(chosen)))
    say(f"{path}: {made.volume!r}")
    for note in made.notes:
        warn(note)
