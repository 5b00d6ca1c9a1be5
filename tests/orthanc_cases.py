"""Pull and push with a real PACS, Orthanc; run by `test_orthanc.py` in a separate network."""

import json
import os
import re
import shutil
import socket
import subprocess
import time
import urllib.error
import urllib.request
from pathlib import Path

import numpy as np
import pydicom
import pytest
from click.testing import CliRunner
from dicomweb_client import DICOMwebClient
from dicomweb_client.session_utils import create_session_from_user_pass

from dicom_phantom import CENTER, save, single
from dicom_series import PLAIN_STACK
from lumencut import Vessel, VesselTree, read_volume, write_centerlines
from lumencut.cli import main
from lumencut.dicom.web.address import Address
from lumencut.dicom.web.client import Client
from lumencut.dicom.web.pulling import pull_instances
from lumencut.dicom.web.queries import find_instances, find_series
from lumencut.viewer.pacs_zip.archive import pacs_zip
from pacs_requests import dropped, encoded, header, members
from pacs_requests import sent as sent_as

PLUGIN = "/usr/share/orthanc/plugins/libOrthancDicomWeb.so"
NAME, PASSWORD = "lumencut", "only-here"
REQUEST = re.compile(r"GET (?:/dicom-web)?/studies/[\d.]+/series/[\d.]+/instances/([\d.]+)$", re.MULTILINE)


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Orthanc:
    """A running Orthanc, and its records of requests."""

    def __init__(self, folder):
        self.http, self.dicom, self.log = free_port(), free_port(), folder / "orthanc.log"
        settings = {
            "Name": "Lumencut's tests",
            "StorageDirectory": str(folder / "storage"),
            "IndexDirectory": str(folder / "storage"),
            "HttpPort": self.http,
            "DicomPort": self.dicom,
            "DicomAet": "ORTHANC",
            "DicomAlwaysAllowStore": True,
            "Plugins": [PLUGIN],
            "RegisteredUsers": {NAME: PASSWORD},
            "AuthenticationEnabled": True,
            "DicomWeb": {"Enable": True, "Root": "/dicom-web/"},
        }
        (folder / "orthanc.json").write_text(json.dumps(settings))
        command = shutil.which("Orthanc", path=f"{os.environ['PATH']}:/usr/sbin")
        self.process = subprocess.Popen(
            [command, "--verbose", f"--logfile={self.log}", folder / "orthanc.json"],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        self.base = f"http://127.0.0.1:{self.http}/dicom-web"
        self.wait()

    def wait(self):
        for _ in range(300):
            try:
                urllib.request.urlopen(f"http://127.0.0.1:{self.http}/system", timeout=2)
            except urllib.error.HTTPError:
                return
            except OSError:
                assert self.process.poll() is None, self.log.read_text()
                time.sleep(0.1)
        raise AssertionError(self.log.read_text())

    def asked(self):
        """Return the instances that were requested, from its log."""
        return REQUEST.findall(self.log.read_text())


@pytest.fixture(scope="module")
def orthanc(tmp_path_factory):
    running = Orthanc(tmp_path_factory.mktemp("orthanc"))
    yield running
    running.process.terminate()
    running.process.wait(20)


@pytest.fixture(autouse=True)
def known(monkeypatch, tmp_path):
    """Write the name and the password into netrc."""
    place = tmp_path / "netrc"
    place.write_text(f"machine 127.0.0.1 login {NAME} password {PASSWORD}\n")
    monkeypatch.setenv("NETRC", str(place))
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))


@pytest.fixture(scope="module")
def scan(tmp_path_factory):
    """A CT of 72 slices; 24 of them have an odd name in an odd character set."""
    folder = tmp_path_factory.mktemp("ct")
    for k in range(72):
        data = single(PLAIN_STACK[k % 24], k + 1)
        data.ImagePositionPatient[2] = f"{2.0 * k:.1f}"
        data.SpecificCharacterSet, data.PatientName = "GB18030", "Wang^XiaoDong=王^小东"
        save(data, folder / f"IM{k:03}.dcm")
    return folder


@pytest.fixture(scope="module")
def stored(orthanc, scan, tmp_path_factory):
    """The scan, pushed into the PACS."""
    home = tmp_path_factory.mktemp("home")
    (home / "netrc").write_text(f"machine 127.0.0.1 login {NAME} password {PASSWORD}\n")
    known = {"NETRC": str(home / "netrc"), "XDG_STATE_HOME": str(home)}
    done = run("push", scan, orthanc.base, "--yes", "--new-study", **known)
    assert done.exit_code == 0, done.output
    assert "72 of 72 objects are in" in done.output
    first = pydicom.dcmread(next(scan.iterdir()))
    return Address(orthanc.base, first.StudyInstanceUID, first.SeriesInstanceUID)


def run(*arguments, **environment):
    return CliRunner(env=environment).invoke(main, [*map(str, arguments)])


def by_uid(folder):
    every = [pydicom.dcmread(path) for path in Path(folder).rglob("*.dcm")]
    return {str(data.SOPInstanceUID): data for data in every}


def test_what_was_pushed_is_what_another_client_finds(stored, scan):
    session = create_session_from_user_pass(NAME, PASSWORD)
    other = DICOMwebClient(stored.base, session=session)
    listed = other.search_for_instances(stored.study, stored.series)
    sent = by_uid(scan)
    assert {one["00080018"]["Value"][0] for one in listed} == set(sent)
    for data in other.iter_series(stored.study, stored.series):
        np.testing.assert_array_equal(data.pixel_array, sent[str(data.SOPInstanceUID)].pixel_array)


def test_what_is_pulled_is_what_was_pushed(stored, scan, tmp_path):
    done = run("pull", stored, "-o", tmp_path / "out")
    assert done.exit_code == 0, done.output
    sent, got = by_uid(scan), by_uid(tmp_path / "out")
    assert got.keys() == sent.keys()
    assert all(got[uid] == sent[uid] for uid in sent)


def test_a_pull_that_was_cut_off_asks_for_what_is_missing_alone(orthanc, stored, tmp_path):
    out = tmp_path / "out"

    def cut_off(done, total):
        if done == 20:
            raise KeyboardInterrupt

    with Client(stored) as client, pytest.raises(KeyboardInterrupt):
        pull_instances(client, find_instances(client, stored), out, cut_off)
    there = {path.stem for path in out.rglob("*") if path.is_file()}
    assert 20 <= len(there) < 72
    before = len(orthanc.asked())
    done = run("pull", stored, "-o", out)
    assert done.exit_code == 0, done.output
    asked = orthanc.asked()[before:]
    assert len(asked) == 72 - len(there)
    assert there.isdisjoint(asked)
    assert len(by_uid(out)) == 72


def test_an_address_is_read_as_its_files_are(stored, scan):
    np.testing.assert_array_equal(read_volume(str(stored)).array, read_volume(scan).array)


def test_studies_are_listed_and_wrong_passwords_named(orthanc, stored, tmp_path):
    listed = run("pull", orthanc.base, "--patient", "Wang*", "--modality", "CT")
    assert listed.exit_code == 0, listed.output
    assert str(Address(stored.base, stored.study)) in listed.output
    assert "72" in listed.output
    (tmp_path / "wrong").write_text("machine 127.0.0.1 login lumencut password no\n")
    wrong = run("pull", stored, "-o", tmp_path / "out", NETRC=str(tmp_path / "wrong"))
    assert wrong.exit_code == 1
    assert "wrong or expired" in wrong.output


def test_the_line_for_dcmtk_stores_the_same_files(orthanc, stored, tmp_path):
    data = single(PLAIN_STACK[0], 1, series=8)
    (tmp_path / "results").mkdir()
    save(data, tmp_path / "results" / "one.dcm")
    words = Path(__file__).parents[1].joinpath("docs/clinic.md").read_text()
    (line,) = re.findall(r"^dcmsend .*$", words, re.MULTILINE)
    line = line.replace("PACS pacs.example 11112", f"ORTHANC 127.0.0.1 {orthanc.dicom}")
    subprocess.run(line.split(), cwd=tmp_path, check=True, capture_output=True, timeout=60)
    with Client(stored) as client:
        (found,) = find_instances(client, Address(stored.base, data.StudyInstanceUID, data.SeriesInstanceUID))
    assert found.uid == data.SOPInstanceUID


def test_from_a_scan_to_pictures_and_numbers_beside_it_in_three_commands(stored, tmp_path):
    lines = VesselTree([Vessel(CENTER + [[-4, 3, z] for z in range(-18, 19, 2)], 3.0, "aorta")])
    write_centerlines(lines, tmp_path / "lines.vtp")
    out = tmp_path / "out"
    out.mkdir()
    for words in (
        ("render", stored, tmp_path / "lines.vtp", "--size", "256x256", "-o", out / "csr.dcm"),
        ("measure", stored, tmp_path / "lines.vtp", "-o", tmp_path / "a.csv", "--dicom", out / "numbers"),
        ("push", out, stored.base, "--yes"),
    ):
        done = run(*words)
        assert done.exit_code == 0, done.output
    with Client(stored) as client:
        found = find_series(client, Address(stored.base, stored.study))
    made = [
        one.texts["modality"] for one in found if "(research, not for diagnosis)" in one.texts["description"]
    ]
    assert {"CT", "SR", "DOC"} == set(made)


def test_what_the_viewer_saves_for_a_pacs_is_read_back_from_it(orthanc, tmp_path):
    unpacked, got = tmp_path / "unpacked", tmp_path / "got"
    # The server already has a study with this UID, of another patient.
    own = header().replace(b"1.2.826.0.1.3680043.10.1000.1", b"1.2.826.0.1.3680043.10.1000.7")
    sent = members(pacs_zip(sent_as(dropped(header=encoded(own))), None), unpacked)
    assert len(sent) == 5
    pushed = run("push", unpacked, orthanc.base, "--yes", "--new-study")
    assert pushed.exit_code == 0, pushed.output
    assert "5 of 5 objects are in" in pushed.output
    every = by_uid(unpacked)
    (study,) = {data.StudyInstanceUID for data in every.values()}
    pulled = run("pull", Address(orthanc.base, study), "-o", got)
    assert pulled.exit_code == 0, pulled.output
    back = by_uid(got)
    assert every.keys() <= back.keys()
    for uid, data in every.items():
        assert back[uid] == data
        assert str(back[uid].PatientName) == "Doe^Jane"
