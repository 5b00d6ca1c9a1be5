"""``lumencut endoscopy`` and ``lumencut fly``: a vessel seen from inside, as a picture and as a film."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from lumencut.cli import options
from lumencut.cli.dicom import study_of
from lumencut.cli.laid_out import each
from lumencut.cli.laid_out.films import film, film_writer
from lumencut.cli.report import say, warn

if TYPE_CHECKING:
    from lumencut.reformations.endoscopic_view import Endoscopy


def show_endoscopy(**given: Any) -> None:
    """Write the picture from one place in the longest vessel."""
    options.check_picture(given["output"])
    chosen, settings = each.like(given, "endoscopy")
    renderer, tree, vessels = each.read_vessels(chosen, settings, "endoscopy")
    named = max(vessels, key=lambda one: one[1].length)
    made = each.asked("endoscopy", chosen, settings, tree).of(renderer, named[1])
    for doubt in made.doubts:
        warn(f"vessel {named[0]}: {doubt}")
    each.write_each(chosen, [named], lambda _: made)


def show_flight(**given: Any) -> None:
    """Write the film of a flight through the longest vessel."""
    output, fps = given["output"], given["fps"]
    chosen, settings = each.like(given, "fly")
    dicom = {**study_of(chosen), "compress": chosen["compress"], "grey": chosen["grey"]}
    write = film_writer(output, fps, dicom)
    renderer, tree, vessels = each.read_vessels(chosen, settings, "fly")
    title, vessel = max(vessels, key=lambda one: one[1].length)
    start, end = chosen["start"], vessel.length if chosen["end"] is None else chosen["end"]

    from lumencut.reformations.endoscoping import flight

    view = {**chosen, "at": start, "backwards": end < start}
    first = each.asked("endoscopy", view, settings, tree).of(renderer, vessel)
    places = flight(first, end, chosen["speed"], fps)
    doubtful: list[str] = []
    views = _views(first, places, doubtful)
    write(film("fly", views, len(places), annotate=chosen["annotate"]), fps)
    if doubtful:
        warn(f"vessel {title}: {len(doubtful)} of {len(places)} frames are doubtful; first: {doubtful[0]}")
    say(f"{output}: flight through vessel {title}, {len(places)} frames, {len(places) / fps:.3g} s")


def _views(first: Endoscopy, places: list[float], doubtful: list[str]) -> Iterator[Endoscopy]:
    """Yield the views from the places; collect one doubt of each doubtful view."""
    for at in places:
        made = first.changed(at)
        doubtful += made.doubts[:1]
        yield made
