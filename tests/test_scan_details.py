"""Measured numbers come with the acquisition details of their scan, as its file states them."""

import copy
import csv
import io
import json
import pickle
from dataclasses import asdict

import numpy as np
import pytest

from dicom_phantom import CENTER, axial, images, single
from lumencut import Measurements, ScanDetails, Vessel, VesselTree, Volume, measure, read_volume
from lumencut.files.volumes import open_volume
from lumencut.measuring.profile_files import csv_text, json_text
from lumencut.viewer.volume_stream import header

WHOLE = ScanDetails("3", "CTA 2.0", "70 % of the cardiac cycle", 2.0, "Bv40f, 3")


def written(folder, change):
    """Write a series of the phantom with changed headers."""
    folder.mkdir()
    for number, image in enumerate(images(axial()), 1):
        data = single(image, number)
        change(data)
        data.save_as(folder / f"{number}.dcm", enforce_file_format=True)
    return folder


def telling(data):
    data.SeriesDescription, data.ConvolutionKernel = "CTA 2.0", ["Bv40f", "3"]
    data.NominalPercentageOfCardiacPhase = 70.0


def anonymised(data):
    for name in ("SeriesDescription", "SeriesNumber", "SliceThickness"):
        delattr(data, name)


@pytest.fixture(scope="module")
def series(tmp_path_factory):
    return written(tmp_path_factory.mktemp("scan") / "told", telling)


@pytest.fixture(scope="module")
def line():
    heights = np.linspace(-18, 18, 37)
    points = CENTER + np.stack([np.full(37, -4.0), np.full(37, 3.0), heights], axis=1)
    return Vessel(points, np.full(37, 3.0))


@pytest.fixture(scope="module")
def profile(series, line):
    return measure(read_volume(series), line, 2.0, 1.0)


def test_a_volume_and_what_is_measured_in_it_keep_what_the_file_tells(series, line, profile):
    volume = read_volume(series)
    assert volume.scan == profile.scan == WHOLE
    assert Measurements(volume, VesselTree([line]), 2.0).profile(line).scan == WHOLE
    assert pickle.loads(pickle.dumps(volume)).scan == copy.copy(volume).scan == WHOLE
    assert str(WHOLE) == (
        "series 3, CTA 2.0; phase 70 % of the cardiac cycle; slice thickness 2 mm; kernel Bv40f, 3"
    )


def test_tables_and_json_tell_it(profile):
    names = ("series_number", "series_description", "phase", "slice_thickness_mm", "kernel")
    rows = list(csv.DictReader(io.StringIO(csv_text(profile))))
    expected = ("3", "CTA 2.0", "70 % of the cardiac cycle", "2", "Bv40f, 3")
    assert {tuple(row[name] for name in names) for row in rows} == {expected}
    told = json.loads(json_text(profile))["scan"]
    assert tuple(told[name] for name in names) == (*expected[:3], 2.0, expected[4])


def test_the_viewer_gets_it_too_and_tables_do_not_name_the_patient(series, profile):
    file = open_volume(series)
    stream = header(file, file.dtype)
    told = json.loads(stream[stream.index(b"{") :])["scan"]
    expected = asdict(WHOLE)
    expected["slice_thickness_mm"] = expected.pop("slice_thickness")
    assert told == expected
    for text in (csv_text(profile), json_text(profile)):
        assert "phantom" not in text.lower()
    # The page rejects the scan of another patient next to this one, so it gets the id, but no name.
    assert stream.decode(errors="replace").lower().count("phantom") == 1
    assert b'"patient": "phantom"' in stream.lower()


def test_what_an_anonymised_file_does_not_tell_is_named_as_such(tmp_path, line):
    volume = read_volume(written(tmp_path / "bare", anonymised))
    assert volume.scan == ScanDetails()
    assert str(volume.scan) == "series, phase, slice thickness, kernel not stated"
    (row, *_) = csv.DictReader(io.StringIO(csv_text(measure(volume, line, 2.0, 1.0))))
    assert (row["series_number"], row["slice_thickness_mm"], row["kernel"]) == (
        "not stated",
        "",
        "not stated",
    )


def test_volumes_of_other_sources_tell_nothing():
    assert Volume(np.zeros((2, 2, 2), np.int16)).scan == ScanDetails()
