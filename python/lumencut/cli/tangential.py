"""``lumencut cpr --mode tangential``: its view and its options."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from lumencut.cli import options
from lumencut.cli.like import typed

if TYPE_CHECKING:
    from lumencut.renderer import Renderer
    from lumencut.settings import Settings
    from lumencut.tangential import TangentialReformation
    from lumencut.vessel import Vessel

MODE = "tangential"

#: Options of the tangential mode only, and options of the other modes only.
_OWN, _OTHERS = ("view", "size"), ("width", "angle", "roll")

_SIZE = (768, 768)


def check_view(chosen: dict[str, Any]) -> None:
    """Reject options that have no effect in the chosen mode."""
    is_own = chosen["mode"] == MODE
    idle = [name for name in (_OTHERS if is_own else _OWN) if name in typed(chosen)]
    if idle:
        mend = f"leave out --{idle[0]}, or choose {'another mode' if is_own else f'--mode {MODE}'}"
        raise click.UsageError(f"--{idle[0]} does nothing with --mode {chosen['mode']}; {mend}")


def tangential(
    renderer: Renderer, vessel: Vessel, chosen: dict[str, Any], settings: Settings
) -> TangentialReformation:
    """Return the tangential CPR in the view of --like, or in that of the options, fitted to the vessel."""
    from lumencut.reformation_recipe import recipe_camera
    from lumencut.tangential import tangential_of
    from lumencut.vessel_tree import VesselTree

    if chosen["camera"] is not None and not {*_OWN, "up", "pixel_spacing"} & typed(chosen).keys():
        camera = recipe_camera(chosen["camera"])
        return tangential_of(renderer, vessel, camera, smoothing=chosen["smoothing"], settings=settings)
    still = {"rotate": 0.0, "tilt": 0.0, "zoom": 1.0, "center": None}
    up = chosen["up"] if "up" in typed(chosen) else None
    placed = {
        **chosen,
        **still,
        "up": up,
        "view": chosen["view"] or "anterior",
        "size": chosen["size"] or _SIZE,
    }
    camera = options.placed(options.view_from(placed), VesselTree([vessel]), placed)
    return tangential_of(renderer, vessel, camera, smoothing=chosen["smoothing"], settings=settings)
