"""A volume that is sent while it is read, and a volume that cannot be read completely."""

import threading
import time
from http.client import IncompleteRead

import numpy as np
import pytest

from lumencut import FormatError, Volume, VolumeError
from lumencut.files.volume_writers import write_volume as write_any
from lumencut.files.volumes import open_volume
from lumencut.viewer.arriving import ArrivingScene
from view_serving import made_file, serving, split, write_page
from volume_samples import coded, write_stack


@pytest.fixture
def page(tmp_path):
    return write_page(tmp_path / "page")


def test_slices_are_sent_as_they_come_in(page):
    array, seen = coded(), threading.Event()

    def load(progress, filled):
        voxels = np.empty_like(array)
        voxels[:2] = array[:2]
        filled(voxels, 2)
        assert seen.wait(10)
        voxels[2:] = array[2:]
        return voxels

    with serving(page, ArrivingScene(made_file(array, load))) as client:
        connection = client.connection()
        connection.request("GET", f"/{client.place.token}/data/volume")
        response = connection.getresponse()
        length = int(response.headers["Content-Length"])
        early = response.read(length - array[2:].nbytes)
        assert split(early)[1] == array[:2].tobytes()
        seen.set()
        assert response.read() == array[2:].tobytes()
        connection.close()


def test_where_only_the_values_tell_the_type_the_header_waits(page):
    array, asked = coded(dtype=np.int32), threading.Event()

    def load(progress, filled):
        assert asked.wait(10)
        return array

    with serving(page, ArrivingScene(made_file(array, load, settled=False))) as client:
        connection = client.connection()
        connection.request("GET", f"/{client.place.token}/data/volume")
        asked.set()
        header, voxels = split(connection.getresponse().read())
        connection.close()
    assert (header["dtype"], voxels) == ("int32", array.tobytes())


@pytest.mark.parametrize("name", ["ct.nii", "ct.nii.gz", "dicom"])
def test_readers_tell_of_slices_that_are_final(tmp_path, name):
    side = 64 if name == "dicom" else 256
    array = np.random.default_rng(1).integers(0, 1000, (30, side, side), np.int16)
    path = tmp_path / name
    if name == "dicom":
        path.mkdir()
        write_stack(path, array, np.eye(4))
    else:
        write_any(Volume(array), path)
    told = []

    def filled(voxels, count):
        told.append(count)
        np.testing.assert_array_equal(voxels[:count], array[:count])

    open_volume(path).volume(lambda done, total: None, filled)
    assert told[-1] == 30
    assert told == sorted(set(told))
    assert len(told) > 1


@pytest.mark.parametrize(
    ("stored", "header", "known"),
    [
        (np.int16, {"BitsStored": 12}, "int16"),
        (np.int16, {"BitsStored": 16, "RescaleIntercept": "-1024"}, None),
        (np.uint16, {"BitsStored": 12, "RescaleIntercept": "-1024"}, "int16"),
        (np.uint16, {"BitsStored": 16}, None),
        (np.int16, {"RescaleSlope": "0.5"}, "float32"),
    ],
)
def test_headers_of_dicom_settle_the_type_where_they_can(tmp_path, stored, header, known):
    def change(k, data):
        for name, value in header.items():
            setattr(data, name, value)
        if "BitsStored" in header:
            data.HighBit = header["BitsStored"] - 1

    write_stack(tmp_path, coded(dtype=stored), np.eye(4), change)
    file = open_volume(tmp_path)
    assert file.settled_type == (None if known is None else np.dtype(known))
    assert known in (None, file.volume(lambda done, total: None).dtype.name)


def test_the_end_of_the_server_stops_the_reading(page):
    begun = threading.Event()

    def load(progress, filled):
        begun.set()
        while True:
            progress(0, 1)
            time.sleep(0.01)

    scene = ArrivingScene(made_file(coded(), load))
    with serving(page, scene) as client:
        assert begun.wait(10)
        connection = client.connection()
        connection.request("GET", f"/{client.place.token}/data/volume")
    connection.close()
    assert not scene._thread.is_alive()
    assert scene.problem is None


def test_who_goes_away_is_not_missed(page, caplog):
    array = np.zeros((40, 512, 512), np.int16)
    with serving(page, ArrivingScene(made_file(array))) as client:
        connection = client.connection()
        connection.request("GET", f"/{client.place.token}/data/volume")
        connection.getresponse().read(1000)
        connection.close()
        assert client.ask("data/volume").body.endswith(array.tobytes())
    assert caplog.records == []


def fails(after):
    def load(progress, filled):
        voxels = np.ascontiguousarray(coded())
        if after:
            filled(voxels, after)
        raise FormatError("/somewhere/made.nrrd", "7 bytes", "120 bytes", "copy the file again")

    return load


def test_a_volume_that_breaks_off_is_noticed_and_explained(page, caplog):
    with serving(page, ArrivingScene(made_file(coded(), fails(after=2)))) as client:
        # The first request may come before or after the failure.
        broken = client.ask("data/volume")
        words = client.ask("data/problem")
        later = client.ask("data/volume")
        assert client.ask().status == 200
    assert [record.name for record in caplog.records] == ["lumencut"]
    if broken.status == 200:
        assert len(broken.body) < int(broken.headers["content-length"])
    assert (words.status, words.headers["content-type"]) == (200, "text/plain; charset=utf-8")
    told = "made.nrrd: found 7 bytes; expected 120 bytes; copy the file again"
    assert words.body.decode() == told
    assert later.status == 422


def test_the_connection_ends_early_where_the_header_is_sent(page):
    asked = threading.Event()

    def load(progress, filled):
        assert asked.wait(10)
        return fails(after=3)(progress, filled)

    with serving(page, ArrivingScene(made_file(coded(), load))) as client:
        connection = client.connection()
        connection.request("GET", f"/{client.place.token}/data/volume")
        response = connection.getresponse()
        assert client.ask("data/problem").status == 404
        asked.set()
        with pytest.raises(IncompleteRead):
            response.read()
        problem = client.ask("data/problem")
        connection.close()
    assert problem.status == 200
    assert problem.body.decode() == "made.nrrd: found 7 bytes; expected 120 bytes; copy the file again"


def test_before_the_header_the_error_is_told_in_parts(page):
    with serving(page, ArrivingScene(made_file(coded(), fails(after=0), settled=False))) as client:
        answer = client.ask("data/volume")
    assert answer.status == 422
    assert answer.json == {
        "kind": "format",
        "subject": "made.nrrd",
        "found": "7 bytes",
        "expected": "120 bytes",
        "mend": "copy the file again",
    }


def test_an_unexpected_error_tells_nothing_of_itself(page):
    def load(progress, filled):
        raise VolumeError("x", "y", "z") from KeyError("secret")

    with serving(page, ArrivingScene(made_file(coded(), load, settled=False))) as client:
        assert b"secret" not in client.ask("data/volume").body


def test_a_type_that_is_not_as_the_headers_say_is_told_and_then_mended(page):
    wide = coded(dtype=np.int32)
    file = made_file(coded(dtype=np.int16), lambda progress, filled: wide)
    scene = ArrivingScene(file)
    with serving(page, scene) as client:
        scene._thread.join()
        assert b"found voxels of type int32; expected int16" in client.ask("data/problem").body
        header, voxels = split(client.ask("data/volume").body)
    assert (header["dtype"], voxels) == ("int32", wide.tobytes())


def test_a_damaged_file_is_told_by_its_name_alone(page, tmp_path):
    path = tmp_path / "ct.nii"
    write_any(Volume(coded()), path)
    file = open_volume(path)
    path.write_bytes(path.read_bytes()[:-7])
    with serving(page, ArrivingScene(file)) as client:
        client.ask("data/volume")
        words = client.ask("data/problem").body.decode()
    assert words.startswith("ct.nii: found 113 bytes of voxels; expected 120 bytes")
    assert str(tmp_path) not in words
