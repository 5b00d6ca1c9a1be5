"""Addresses of a PACS: which are invalid, and that they are accepted in place of a volume."""

from pathlib import Path

import numpy as np
import pydicom
import pytest

from dicom_phantom import save
from lumencut import Volume, list_series, read_volume
from lumencut.dicom.web.address import parsed_address
from lumencut.dicom.web.source import fetched
from lumencut.errors import FormatError, LumencutError
from lumencut.viewer import page as page_room
from lumencut.viewer.server import ViewerServer
from pacs_scenes import forget_user, holding, run, write_scan
from pacs_stub import Pacs, running
from segmentation_files import segmentation
from view_serving import Client, split, write_page


@pytest.fixture(scope="module")
def scan(tmp_path_factory):
    return write_scan(tmp_path_factory.mktemp("ct"))


@pytest.fixture(autouse=True)
def nobody_known(monkeypatch, tmp_path):
    forget_user(monkeypatch, tmp_path)


@pytest.fixture
def pacs(scan):
    with holding(scan) as one:
        yield one


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ("http://pacs.example/dicom-web", "which anybody on the network can read"),
        ("https://me:pw1@pacs.example/web", "a name or a password"),
        ("https://pacs.example/web?token=1", "dicomweb:https://HOST"),
        ("https://pacs.example/web/studies/..%2f1", "dicomweb:https://HOST"),
        ("https://pacs.example/studies/1/series/2/instances/3", "dicomweb:https://HOST"),
        ("ftp://pacs.example", "dicomweb:https://HOST"),
        ("https://[::1", "dicomweb:https://HOST"),
    ],
)
def test_addresses_that_are_none_are_refused(given, words):
    with pytest.raises(FormatError, match="address") as caught:
        parsed_address(given)
    assert words in str(caught.value)
    assert "pw1" not in str(caught.value)


def test_options_of_other_files_are_refused_without_a_request():
    with pytest.raises(FormatError, match=r"memory for a file of another kind.*leave memory out"):
        read_volume("dicomweb:https://pacs.invalid/studies/1.2", memory=10**9)


def test_a_path_keeps_the_address():
    given = "dicomweb:https://pacs.example/dicom-web/studies/1.2/series/3.4"
    assert parsed_address(Path(given)) == parsed_address(given)
    assert str(parsed_address(Path(given))) == given


def test_an_address_stands_where_a_volume_stands(pacs, scan, tmp_path):
    given = f"dicomweb:{pacs.address}"
    seen = []
    volume = read_volume(given, progress=lambda done, total: seen.append((done, total)))
    np.testing.assert_array_equal(volume.array, read_volume(scan).array)
    assert (24, 24) in seen
    folder = fetched(given).path
    assert not folder.exists()
    save(segmentation({1: volume_mask(volume)}, {1: "vessel"}), tmp_path / "seg.dcm")
    pacs.take((tmp_path / "seg.dcm").read_bytes())
    study = f"dicomweb:{pacs.base}/studies/{pacs.study}"
    told = run("info", study)
    assert told.exit_code == 0, told.output
    assert "value range  -33, 372" in told.output
    table = tmp_path / "studies.csv"
    table.write_text(f"id,volume,mask\np1,{study},seg.dcm\n")
    done = run("batch", table, "-o", tmp_path / "out", "--jobs", "1")
    assert done.exit_code == 0, done.output
    missing = run("info", f"dicomweb:{pacs.base}/studies/1.2.3")
    assert missing.exit_code == 1
    assert "no such study" in missing.output


def volume_mask(volume):
    return Volume((volume.array > 200).astype(np.uint8), world_from_index=volume.world_from_index)


def test_the_viewer_serves_what_it_fetched_from_this_machine_alone(pacs, scan, tmp_path, monkeypatch):
    monkeypatch.setattr(page_room, "FOLDER", write_page(tmp_path / "page"))
    bodies = []

    def ask(server):
        bodies.append(Client(server).ask("data/volume").body)

    monkeypatch.setattr(ViewerServer, "wait", ask)
    shown = run("view", f"dicomweb:{pacs.address}", "--no-browser")
    assert shown.exit_code == 0, shown.output
    header, voxels = split(bodies[0])
    assert header["size"] == [64, 48, 24]
    assert voxels == read_volume(scan).array.astype(np.int16).tobytes()


def test_a_study_of_several_series_is_listed_and_chosen_from(pacs, scan, tmp_path):
    for path in sorted(scan.iterdir()):
        data = pydicom.dcmread(path)
        data.SeriesInstanceUID += ".9"
        data.SOPInstanceUID += ".9"
        data.file_meta.MediaStorageSOPInstanceUID = data.SOPInstanceUID
        data.SeriesNumber = 9
        save(data, tmp_path / path.name)
    pacs.add(tmp_path)
    study = f"dicomweb:{pacs.base}/studies/{pacs.study}"
    several = run("info", study)
    assert several.exit_code == 0, several.output
    assert "--series" in several.output
    pacs.asked.clear()
    assert read_volume(study, series=9).size == (64, 48, 24)
    assert all(uid.endswith(".9") for uid in pacs.asked)
    assert len(pacs.asked) == 24
    assert len(list_series(study)) == 2


def test_a_server_that_is_not_there_is_named(tmp_path):
    with running(Pacs()) as pacs:
        base = pacs.base
    with pytest.raises(LumencutError, match="no connection"):
        read_volume(f"dicomweb:{base}/studies/1.2.3")
