"""One study of a cohort: its vessels, pictures, measures and tables, written into a folder."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

import numpy as np
import numpy.typing as npt

from lumencut.base.csv_cells import written
from lumencut.cohort.manifest import Study
from lumencut.cohort.recipe import CohortRecipe, Measure, Pictures
from lumencut.cohort.sources import StudyVessels, scan_of, vessels_of
from lumencut.cohort.study_tables import StudyVessel, flag_counts, sections_rows, vessels_rows
from lumencut.errors import MeasuringError
from lumencut.files.centerline_writers import write_centerlines
from lumencut.measuring.measured_vessel import Marked, MeasuredVessel
from lumencut.measuring.sections import measure
from lumencut.pictures.contact_sheet import contact_sheet
from lumencut.pictures.picture_file import save_picture
from lumencut.pictures.renderer import Renderer
from lumencut.reformations.planar_reformation import CprRequest
from lumencut.reports.measure_report import report
from lumencut.scene.camera import VIEWS, Camera
from lumencut.scene.settings import Settings
from lumencut.scene.vessel_tree import VesselTree
from lumencut.scene.volume import Volume

Device = Literal["auto", "cpu", "gpu"]

_THUMBNAIL = 144


def do_study(
    study: Study, recipe: CohortRecipe, folder: Path, device: Device
) -> dict[str, str | int | float]:
    """Process one study by the recipe.

    Parameters
    ----------
    study : Study
        Its entry in the manifest.
    recipe : CohortRecipe
        What to do.
    folder : Path
        The existing folder for its files.
    device : {"auto", "cpu", "gpu"}
        The device that renders, as for :class:`lumencut.Renderer`.

    Returns
    -------
    dict of str
        The columns of the study in ``studies.csv``.

    Raises
    ------
    LumencutError
        For unreadable files, scans without vessels, and lines outside the scan.
    """
    volume = scan_of(study, recipe.reading)
    found = vessels_of(study, volume, recipe.centerlines)
    has_doubtful = recipe.centerlines.doubtful and bool(found.doubtful)
    tree = (
        VesselTree([*found.tree, *(vessel for vessel, _ in found.doubtful)]) if has_doubtful else found.tree
    )
    begin = folder / study.label
    if recipe.outputs.centerlines:
        write_centerlines(tree, Path(f"{begin}_desc-centerlines.vtp"))
    renderer = Renderer(volume, tree, device)
    _pictures(renderer, recipe.pictures, begin)
    vessels = _measured(study, volume, tree, recipe.measure)
    measured = [one.measured for one in vessels if one.measured is not None]
    if recipe.outputs.report and measured:
        asked = {
            "step": recipe.measure.step,
            "fwhm": _fwhm(study, recipe.measure),
            "wall": recipe.measure.wall,
        }
        page = report(renderer, volume, measured, {**_NOTHING_MARKED, **asked})
        Path(f"{begin}_report.html").write_text(page, "utf-8")
    if has_doubtful:
        vessels = _with_doubts(vessels, found)
    return _tables(study, vessels, found, begin)


_NOTHING_MARKED = dict.fromkeys(("at", "reference", "method", "original", "comparison", "group"))


def _pictures(renderer: Renderer, how: Pictures, begin: Path) -> None:
    """Render each view with each look, the reformations, and a thumbnail of the first picture."""
    tree, thumbnail = renderer.tree or (), None
    for view in how.views:
        direction, up = (np.array(vector) for vector in VIEWS[view])
        camera = Camera.fitted(renderer.scene, direction, up, how.size)
        for look in how.looks:
            frame = renderer.render(camera, Settings.look(look))
            frame.save(Path(f"{begin}_view-{view}_desc-{look}.png"), annotate=how.annotate)
            thumbnail = frame.image if thumbnail is None else thumbnail
    for mode in how.reformations:
        made = [CprRequest(mode).of(renderer, vessel) for vessel in tree]
        titles = [str(n) if vessel.name is None else f"{n} {vessel.name}" for n, vessel in enumerate(tree)]
        sheet = contact_sheet([one.annotated() if how.annotate else one.image for one in made], titles)
        save_picture(sheet, Path(f"{begin}_desc-{mode}.png"))
        thumbnail = sheet if thumbnail is None else thumbnail
    if thumbnail is not None:
        _write_thumbnail(thumbnail, Path(f"{begin}_thumbnail.webp"))


def _write_thumbnail(image: npt.NDArray[np.uint8], path: Path) -> None:
    from PIL import Image

    small = Image.fromarray(image).convert("RGB")
    small.thumbnail((_THUMBNAIL, _THUMBNAIL))
    small.save(path, format="WEBP", quality=60)


def _measured(study: Study, volume: Volume, tree: VesselTree, how: Measure) -> list[StudyVessel]:
    """Return the vessels with their measures; for those not measured, the reason."""
    vessels = []
    for number, vessel in enumerate(tree):
        if not how.vessels:
            vessels.append(StudyVessel(vessel))
            continue
        try:
            profile = measure(volume, vessel, how.step, _fwhm(study, how), tree=tree, wall=how.wall)
            made = MeasuredVessel.of(str(number), vessel, profile, Marked())
            vessels.append(StudyVessel(vessel, measured=made))
        except MeasuringError as error:
            vessels.append(StudyVessel(vessel, not_measured=str(error)))
    return vessels


def _fwhm(study: Study, how: Measure) -> float | None:
    """Return the width of the point spread; the manifest takes precedence over the recipe."""
    return float(study.reading["fwhm"]) if "fwhm" in study.reading else how.fwhm


def _with_doubts(vessels: list[StudyVessel], found: StudyVessels) -> list[StudyVessel]:
    """Return the certain vessels, then the doubtful ones with their reasons."""
    sure = len(vessels) - len(found.doubtful)
    doubts = ["" for _ in range(sure)] + [reason for _, reason in found.doubtful]
    return [
        StudyVessel(one.vessel, doubt, one.measured, one.not_measured)
        for one, doubt in zip(vessels, doubts, strict=True)
    ]


def _tables(
    study: Study, vessels: list[StudyVessel], found: StudyVessels, begin: Path
) -> dict[str, str | int | float]:
    """Write the tables of the study; return its columns in ``studies.csv``."""
    sections = sections_rows(study.id, study.source, vessels)
    flags = flag_counts(sections)
    rows = vessels_rows(study.id, study.source, vessels, flags)
    Path(f"{begin}_vessels.csv").write_text(written(rows), "utf-8", newline="\n")
    Path(f"{begin}_sections.csv").write_text(written(sections), "utf-8", newline="\n")
    return {
        "centerlines_from": study.source,
        "vessels": len(vessels),
        "length_mm": round(sum(one.vessel.length for one in vessels), 3),
        "doubtful_vessels": len(found.doubtful),
        "not_measured_vessels": sum(bool(one.not_measured) for one in vessels),
        "sections": max(len(sections) - 1, 0),
        "flags": sum(sum(count.values()) for count in flags.values()),
        **_narrowest(vessels),
    }


def _narrowest(vessels: list[StudyVessel]) -> dict[str, str | int | float]:
    """Return the narrowest suggested place of all vessels, and its vessel; None without any."""
    spots = [
        (n, one.measured.profile.narrowest()) for n, one in enumerate(vessels) if one.measured is not None
    ]
    found = [(spot.diameter, n) for n, spot in spots if spot is not None]
    if not found:
        return {}
    diameter, vessel = min(found)
    return {"suggested_narrowest_mm": round(diameter, 4), "suggested_narrowest_vessel": vessel}
