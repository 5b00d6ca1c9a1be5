"""Folders with several DICOM series: all are listed; one is read only if the choice is clear."""

from __future__ import annotations

import json

import numpy as np
import pytest
from click.testing import CliRunner

from lumencut import list_series, read_volume
from lumencut.cli import main
from lumencut.errors import FileError, FormatError, SeriesError
from lumencut.files.volumes import inspect_volume
from test_dicom import AXIAL
from volume_samples import SIZE, assert_maps, coded, save, slice_of, write_stack

UIDS = {"arterial": "1.2.1", "venous": "1.2.2", "scout": "1.2.3", "screen": "1.2.4", "report": "1.2.5"}


def part(name, number, **extra):
    """Move slices of a stack into a separate series."""

    def change(k, data):
        data.SeriesInstanceUID, data.SeriesNumber, data.SeriesDescription = UIDS[name], number, name
        for keyword, value in extra.items():
            setattr(data, keyword, value)

    return change


@pytest.fixture
def study(tmp_path):
    """Write a study with one angiography volume."""
    folder = tmp_path / "study"
    folder.mkdir()
    write_stack(folder / "a", coded(), AXIAL, part("arterial", 2))
    scout = part("scout", 1, ImageType=["ORIGINAL", "PRIMARY", "LOCALIZER"])
    write_stack(folder / "s", coded((6, 5, 3)), AXIAL, scout)
    write_stack(folder / "c", coded((6, 5, 4)), AXIAL, part("screen", 99, Modality="OT"))
    return folder


def test_the_only_angiography_volume_is_read_and_the_others_are_named(study):
    assert_maps(read_volume(study), AXIAL)
    notes = " ".join(inspect_volume(study).notes)
    assert "of 3 series the only angiography volume is read: number 2 (arterial, CT, 4 × 3 × 5" in notes
    assert "number 1 (scout, CT, 6 × 5 × 3" in notes
    assert "a localiser" in notes
    assert "modality OT" in notes


def test_every_series_is_listed(study):
    found = {one.description: one for one in list_series(study)}
    assert set(found) == {"arterial", "scout", "screen"}
    arterial = found["arterial"]
    assert (arterial.number, arterial.uid, arterial.modality, arterial.images) == ("2", "1.2.1", "CT", 5)
    assert (arterial.size, arterial.spacing, arterial.can_be_volume) == (SIZE, (0.5, 0.75, 2.0), True)
    assert (found["scout"].can_be_volume, found["scout"].trouble) == (False, "a localiser")


def test_two_volumes_are_a_choice_for_the_user(study):
    write_stack(study / "v", coded() + 1000, AXIAL, part("venous", 3))
    with pytest.raises(SeriesError, match=r"4 series: .*arterial.*give the folder of one series") as caught:
        read_volume(study)
    assert [one.number for one in caught.value.series] == ["2", "99", "1", "3"]
    assert isinstance(caught.value, FormatError)
    volume = read_volume(study, series=3)
    assert_maps(volume, AXIAL, lambda i, j, k: 1000 + i + 10 * j + 100 * k)


def test_a_volume_with_a_missing_slice_is_not_passed_by(study):
    write_stack(study / "v", coded((4, 3, 12)), AXIAL, part("venous", 3))
    (study / "v" / "IM0004.dcm").unlink()
    with pytest.raises(SeriesError, match=r"venous, CT, 4 × 3 × 12, .*: 1 missing slice"):
        read_volume(study)
    with pytest.raises(FormatError, match="1 missing slice: 1 between"):
        read_volume(study, series="1.2.2")


def test_long_identifiers_are_told_apart(tmp_path):
    stem = "1.2." + "7" * 58 + "."
    for last in "12":
        folder = tmp_path / last
        write_stack(
            folder, coded(), AXIAL, lambda k, d, uid=stem + last: setattr(d, "SeriesInstanceUID", uid)
        )
    with pytest.raises(SeriesError, match="2 series"):
        read_volume(tmp_path)
    assert read_volume(tmp_path, series=stem + "2").size == SIZE


def test_a_number_that_two_series_share_chooses_none(study):
    write_stack(study / "v", coded(), AXIAL, part("venous", 2))
    with pytest.raises(SeriesError, match=r"2 series: .*expected one series with the number or UID '2'"):
        read_volume(study, series=2)
    assert read_volume(study, series="1.2.2").size == SIZE


def phases(folder, **keyword):
    """Write a series of two phases; the values of the second one are larger by 1000."""
    for number, (name, values) in enumerate(keyword.items()):
        for phase, value in enumerate(values):
            array = coded() + 1000 * phase
            for k in range(len(array)):
                save(slice_of(array, AXIAL, k, **{name: value}), folder / f"{number}-{phase}-{k}.dcm")


@pytest.mark.parametrize(
    ("keyword", "values"),
    [
        ("TriggerTime", ["0", "400"]),
        ("TemporalPositionIdentifier", [1, 2]),
        ("ConvolutionKernel", ["B30f", "B60f"]),
    ],
)
def test_one_of_several_phases_is_read_where_it_is_named(tmp_path, keyword, values):
    phases(tmp_path, **{keyword: values})
    with pytest.raises(
        FormatError, match=rf"{keyword} differs \({values[0]} in 5 slices, {values[1]} in 5 slices"
    ):
        read_volume(tmp_path)
    for number, value in enumerate(values):
        volume = read_volume(tmp_path, phase=value)
        assert_maps(volume, AXIAL, lambda i, j, k, add=1000 * number: add + i + 10 * j + 100 * k)
    with pytest.raises(FormatError, match=rf"no phase '7': {keyword} is {values[0]} in 5 slices"):
        read_volume(tmp_path, phase=7)
    if keyword == "TriggerTime":
        assert read_volume(tmp_path, phase=400.0).array.max() == 1423


def test_the_command_line_takes_a_phase(tmp_path):
    phases(tmp_path, TriggerTime=["0", "400"])
    words = ["info", "--json", str(tmp_path)]
    result = CliRunner().invoke(main, words)
    assert result.exit_code == 1
    assert "give the value of the one to read as --phase VALUE" in result.stderr
    (found,) = json.loads(CliRunner().invoke(main, [*words, "--phase", "400"]).stdout)["files"]
    assert found["value_range"] == [1000, 1423]


def test_patient_names_appear_nowhere(study, caplog):
    def named(k, data):
        part("venous", 3)(k, data)
        data.PatientName, data.PatientID, data.InstitutionName = "Doe^Secret", "Secret-1", "Secret Hospital"
        data.PatientBirthDate, data.AccessionNumber = "19500101", "Secret-2"
        data.RescaleSlope = "1"

    write_stack(study / "v", coded(), AXIAL, named)
    with pytest.raises(SeriesError) as caught:
        read_volume(study)
    read_volume(study, series=3)
    report = inspect_volume(study, series=3)
    damaged = study / "v" / "IM0002.dcm"
    damaged.write_bytes(damaged.read_bytes()[:-30])
    with pytest.raises(FormatError) as cut:
        read_volume(study, series=3)
    said = f"{caught.value} {cut.value} {caplog.text} {report} {list_series(study / 'a')}"
    assert "Secret" not in said
    assert "19500101" not in said


def test_many_compressed_slices_are_decoded_by_processes(tmp_path):
    array = np.random.default_rng(2).integers(0, 4000, (48, 16, 12)).astype(np.uint16)
    folder = write_stack(
        tmp_path / "series", array, AXIAL, lambda k, data: data.compress("1.2.840.10008.1.2.5")
    )
    np.testing.assert_array_equal(read_volume(folder).array, array)
    victim = folder / "IM0030.dcm"
    whole = victim.read_bytes()
    victim.write_bytes(whole[: len(whole) - 300])
    with pytest.raises(FormatError, match=r"IM0030\.dcm"):
        read_volume(folder)


def test_what_is_no_folder_of_images_is_named(tmp_path):
    with pytest.raises(FileError, match="no such file"):
        list_series(tmp_path / "nowhere")
    with pytest.raises(FormatError, match="nothing in it"):
        list_series(tmp_path)
    save(slice_of(coded(), AXIAL, 0), tmp_path / "one.dcm")
    (one,) = list_series(tmp_path)
    assert (one.size, one.can_be_volume, one.trouble) == ((4, 3, 1), False, "fewer than 3 images")
