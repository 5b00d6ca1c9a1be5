"""Output of ``lumencut measure --dicom``: numbers, report and pictures in the study of the scan."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from lumencut.cli.dicom import check_study_options, study_of
from lumencut.cli.report import busy, say

if TYPE_CHECKING:
    from lumencut.measuring.measured_vessel import MeasuredVessel
    from lumencut.pictures.renderer import Renderer
    from lumencut.scene.study import Study
    from lumencut.scene.vessel_tree import VesselTree
    from lumencut.scene.volume import Volume


def check_dicom(chosen: dict[str, Any]) -> None:
    """Reject options that DICOM output cannot use before any file is read."""
    if chosen["dicom"] is None:
        for name in ("like_study", "anonymous", "other_patient"):
            if chosen[name]:
                option = f"--{name.replace('_', '-')}"
                raise click.UsageError(
                    f"{option} does nothing without --dicom; give it a folder, or leave out {option}"
                )
        return
    check_study_options(chosen)
    if chosen["dicom"].exists() and not chosen["dicom"].is_dir():
        raise click.UsageError(f"--dicom {chosen['dicom']}: found a file; expected a folder")
    from lumencut.measuring.profile_plot import check_matplotlib
    from lumencut.measuring.structured_report import check_highdicom

    check_highdicom()
    check_matplotlib()


def study_for(voxels: Volume, chosen: dict[str, Any]) -> Study:
    """Return the study of the objects, before anything is measured."""
    from lumencut.dicom.writing.chosen_study import chosen_study

    return chosen_study(voxels._origin, **study_of(chosen))


def write_objects(
    scene: tuple[Volume, VesselTree], measured: Sequence[MeasuredVessel], study: Study, chosen: dict[str, Any]
) -> None:
    """Write the structured report, the PDF, a view and a straightened CPR of each vessel into the folder."""
    from lumencut.pictures.renderer import Renderer

    folder = chosen["dicom"]
    folder.mkdir(exist_ok=True)
    shown = [one.unnamed() for one in measured] if chosen["anonymous"] else list(measured)
    renderer = Renderer(*scene, chosen["device"])
    with busy(f"writing {folder}"):
        _write_numbers(folder / "report.dcm", shown, study)
        _write_pdf(folder / "report-pdf.dcm", shown, study, renderer, chosen)
        count = _write_pictures(folder, shown, study, renderer)
    say(f"{folder}: report.dcm, report-pdf.dcm and {count} pictures")


def _write_numbers(path: Path, shown: list[MeasuredVessel], study: Study) -> None:
    from lumencut.measuring.dicom_profile import measured
    from lumencut.measuring.structured_report import write_report

    graded = [(one, () if one.stenosis is None else (one.stenosis,)) for one in shown]
    write_report(
        path, [measured(one.profile, stenoses, one.vessel, one.marks) for one, stenoses in graded], study
    )


def _write_pdf(
    path: Path, shown: list[MeasuredVessel], study: Study, renderer: Renderer, chosen: dict[str, Any]
) -> None:
    from lumencut.dicom.writing.encapsulated_pdf import write_pdf
    from lumencut.reports.measure_report import report
    from lumencut.reports.report_pdf import report_pdf

    volume = renderer.volume
    assert volume is not None, "vessels are measured in a volume"
    html = report(renderer, volume, shown, chosen)
    write_pdf(path, report_pdf(html, shown), "Lumencut: measured vessels", study)


def _write_pictures(folder: Path, shown: list[MeasuredVessel], study: Study, renderer: Renderer) -> int:
    """Write the view from the front, and each vessel straightened; return the number of pictures."""
    from lumencut.dicom.writing.picture import write_picture
    from lumencut.reformations.planar_reformation import CprRequest
    from lumencut.scene.camera import Camera

    frame = renderer.render(Camera.anterior(renderer.scene, (768, 768)))
    write_picture(folder / "anterior.dcm", frame._as_object(annotate=True, vessel_names=False), study)
    for number, one in enumerate(shown, 1):
        made = CprRequest("straightened").of(renderer, one.vessel)
        picture = made._as_object(annotate=True, vessel_names=False)
        write_picture(folder / f"vessel-{number}.dcm", picture, study, number=number)
    return 1 + len(shown)
