"""A scan read from a DICOM series, and a vessel in it, for tests of written DICOM objects."""

from __future__ import annotations

import atexit
import shutil
from functools import cache
from pathlib import Path
from tempfile import mkdtemp
from typing import Any

import lumencut
from dicom_phantom import CENTER, HOUNSFIELD, axial, images
from dicom_series import Change, Stack
from lumencut import Settings, Vessel, VesselTree, Volume

LINE = VesselTree([Vessel(CENTER + [[-4, 3, z] for z in range(-18, 19, 2)], 3.0, "Aorta of Jane")])
SETTINGS = Settings(context="mip")


def no_change(k: int, data: Any) -> None:
    """Leave the series as it is."""


def write_series(folder: Path, change: Change = no_change, **stack: Any) -> Path:
    """Write the phantom as a CT series; `change` alters each header. Return the folder."""
    folder.mkdir(exist_ok=True)
    Stack(images(axial()), stored=HOUNSFIELD, change=change, **stack)(folder)
    return folder


def stated(k: int, data: Any) -> None:
    """Add all attributes that objects repeat, and some that they must never repeat."""
    data.PatientName, data.PatientID, data.IssuerOfPatientID = "Doe^Jane", "J-17", "Hospital"
    data.PatientBirthDate, data.PatientSex, data.PatientAge = "19500102", "F", "076Y"
    data.AccessionNumber, data.StudyDescription = "A-4711", "CTA abdomen"
    data.ReferringPhysicianName, data.BodyPartExamined = "Roe^Richard", "ABDOMEN"
    data.InstitutionName, data.DeviceSerialNumber = "Secret hospital", "SN-1"
    data.RequestedProcedureID, data.OperatorsName = "R-1", "Smith"
    data.KVP = "120"
    data.private_block(0x0029, "SECRET", create=True).add_new(1, "LO", "private")


@cache
def series() -> Path:
    """A folder with one series with all these attributes."""
    folder = mkdtemp(prefix="lumencut-series-")
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return write_series(Path(folder), stated)


@cache
def scan() -> Volume:
    """The volume of that folder."""
    return lumencut.read_volume(series())
