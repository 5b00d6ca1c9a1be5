"""The steps that the page requests, one by one: drags, the wheel, clicks and keys."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from lumencut.errors import LumencutError
from lumencut.notebook import gestures
from lumencut.notebook.linked import Linked
from lumencut.notebook.scene import Pick
from lumencut.notebook.shown import Shown
from lumencut.scene.camera import VIEWS, Camera
from lumencut.scene.window import WINDOW_NAMES, Window


@dataclass(frozen=True)
class Taken:
    """The result of steps: state, state at the start of the last drag, and error of a step."""

    view: Shown
    before: Shown
    words: str = ""


def take(view: Shown, before: Shown, steps: Sequence[Sequence[Any]]) -> Taken:
    """Apply steps one after the other; a failed step changes nothing and is reported.

    Parameters
    ----------
    view : Shown
        The state.
    before : Shown
        The state at the start of the current drag, for undo.
    steps : sequence of sequences
        The name of each step, then its numbers: a drag in pixels to the right and down, pixels as column and
        row from the middle of the first one.
    """
    words = ""
    for name, *numbers in steps:
        if name == "begin":
            before = view
        elif name == "back":
            view = before
        else:
            try:
                view = _STEPS[name](view, *numbers)
            except LumencutError as error:
                words = str(error)
    return Taken(view, before, words)


def _rotate(view: Shown, right: float, down: float) -> Shown:
    return replace(view, camera=gestures.trackballed(view.camera, view.pivot, right, down))


def _spin(view: Shown, right: float, _: float) -> Shown:
    """Turn about the direction of the picked vessel at its section."""
    axis = view.camera.up if view.linked is None else view.linked.section.normal
    return replace(view, camera=gestures.spun(view.camera, view.pivot, axis, right))


def _pan(view: Shown, right: float, down: float) -> Shown:
    return replace(view, camera=gestures.panned(view.camera, right, down))


def _zoom(view: Shown, factor: float, column: float, row: float) -> Shown:
    return replace(view, camera=gestures.zoomed(view.camera, factor, column, row))


def _window(view: Shown, right: float, down: float) -> Shown:
    window = gestures.dragged_window(view.seen.window(view.settings), right, down)
    return _with_window(view, window)


def _with_window(view: Shown, window: Window | str | None) -> Shown:
    return replace(view, settings=view.seen.with_window(view.settings, window))


def _preset(view: Shown, number: int) -> Shown:
    return _with_window(view, WINDOW_NAMES[number])


def _named_view(view: Shown, name: str) -> Shown:
    return replace(view, camera=Camera.named(name, view.seen.renderer.scene, view.camera.size))


def _reset(view: Shown) -> Shown:
    return _with_window(_named_view(view, next(iter(VIEWS))), None)


def _silhouettes(view: Shown) -> Shown:
    return replace(view, settings=replace(view.settings, silhouettes=not view.settings.silhouettes))


def _click(view: Shown, pane: str, column: float, row: float) -> Shown:
    pixel = (float(column), float(row))
    if pane == "vessels":
        pick = view.seen.picked(view.camera, view.settings, pixel)
        return view.with_pick(pick) if view.tracing is None else view.traced(pick.point)
    if view.linked is None:
        return view
    point = view.linked.world_from_pixel(pane, pixel)
    place = view.linked.place_at(pane, pixel)
    return view.with_pick(Pick(point, place)) if np.isfinite(point).all() else view


def _double_click(view: Shown, pane: str, column: float, row: float) -> Shown:
    """The first click has already moved the cross-hair there, or set the last point of a vessel."""
    if view.tracing is not None and pane == "vessels":
        view.tracing.end()
        return view.retraced()
    return _click(view, pane, column, row)


def _undo(view: Shown) -> Shown:
    if view.tracing is not None:
        view.tracing.undo()
    return view.retraced()


def _end(view: Shown) -> Shown:
    if view.tracing is not None:
        view.tracing.end()
    return view.retraced()


def _scroll(view: Shown, pane: str, notches: int) -> Shown:
    if view.linked is None:
        return view
    change: Callable[[int], Linked] = view.linked.turned if pane == "straightened" else view.linked.scrolled
    return view.with_linked(change(notches))


_STEPS: dict[str, Callable[..., Shown]] = {
    "rotate": _rotate,
    "spin": _spin,
    "pan": _pan,
    "zoom": _zoom,
    "window": _window,
    "preset": _preset,
    "view": _named_view,
    "reset": _reset,
    "silhouettes": _silhouettes,
    "click": _click,
    "double click": _double_click,
    "scroll": _scroll,
    "undo": _undo,
    "end": _end,
}
