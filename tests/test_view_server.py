"""The viewer's server: the page, the stream of the volume while it is read, and the centerlines."""

import threading
import time
from http.client import IncompleteRead

import numpy as np
import pytest

from lumencut import FormatError, Volume, VolumeError, read_centerlines, read_volume
from lumencut.cli.view import _scene
from lumencut.viewer import volume_stream
from lumencut.viewer.arriving import ArrivingScene
from lumencut.viewer.page import Page
from lumencut.volume_files import open_volume
from lumencut.volume_writers import write_volume as write_any
from scene_files import bent_line, write_lines, write_volume
from view_serving import INDEX, SCRIPT, made_file, serving, split, write_page
from volume_samples import coded, oblique, write_stack

SENT_ALIKE = ["int8", "uint8", "int16", "uint16", "int32", "uint32", "float32", "float64"]
AS_WRITTEN = {"coordinates": None, "unit": None, "series": None, "phase": None}
AS_WRITTEN |= {"fill_gaps": False, "resample_slices": False}


@pytest.fixture
def page(tmp_path):
    return write_page(tmp_path / "page")


def streamed(page, file):
    """Header and voxels of a file, as an array [k, j, i]."""
    with serving(page, ArrivingScene(file)) as client:
        answer = client.ask("data/volume")
    assert answer.status == 200
    assert answer.headers["content-type"] == "application/vnd.lumencut.volume"
    assert int(answer.headers["content-length"]) == len(answer.body)
    header, voxels = split(answer.body)
    kind = np.dtype(header["dtype"]).newbyteorder("<")
    return header, np.frombuffer(voxels, kind).reshape(header["size"][::-1])


# The page


def test_the_page_is_served_as_it_was_built(page):
    with serving(page) as client:
        index, script, wasm = (client.ask(name) for name in ("", "assets/app.js", "assets/core.wasm"))
    assert (index.status, index.body.decode()) == (200, INDEX)
    assert index.headers["content-type"] == "text/html; charset=utf-8"
    assert (script.status, script.body) == (200, SCRIPT)
    assert script.headers["content-type"] == "text/javascript; charset=utf-8"
    assert wasm.headers["content-type"] == "application/wasm"


def test_a_query_belongs_to_the_page(page):
    with serving(page) as client:
        assert client.ask("?volume=data/volume").body.decode() == INDEX


def test_without_the_last_slash_the_page_is_found(page):
    with serving(page) as client:
        answer = client.ask(path=f"/{client.place.token}")
        assert (answer.status, answer.headers["location"]) == (308, f"/{client.place.token}/")


@pytest.mark.parametrize(
    ("has_tree", "names"), [(False, ["volume"]), (True, ["volume", "centerlines"])], ids=["volume", "both"]
)
def test_the_head_of_the_page_names_the_data_that_exist(page, has_tree, names):
    scene = ArrivingScene(made_file(coded()), (lambda volume: None) if has_tree else None)
    with serving(page, scene) as client:
        index = client.ask().body.decode()
    for name in ("volume", "centerlines"):
        tag = f'<meta name="lumencut-{name}" content="data/{name}">'
        assert (tag in index.partition("</head>")[0]) == (name in names)


def test_without_a_scene_there_are_no_data(page):
    with serving(page) as client:
        for name in ("data/volume", "data/centerlines", "data/problem", "data/", "data"):
            assert client.ask(name).status == 404


def test_an_index_without_a_head_is_refused(page):
    (page / "index.html").write_text("no page")
    with pytest.raises(FormatError, match="a page without a head"):
        Page.of(page)


# The volume


@pytest.mark.parametrize("name", SENT_ALIKE)
def test_voxels_arrive_to_the_byte(page, name):
    array = coded(dtype=name)
    header, voxels = streamed(page, made_file(array, affine=oblique(), notes=["one", "two — three"]))
    assert header == {
        "version": 1,
        "name": "made.nrrd",
        "size": [4, 3, 5],
        "dtype": name,
        "world_from_index": oblique().tolist(),
        "states_spacing": True,
        "states_orientation": True,
        "filled_slices": [],
        "notes": ["one", "two — three"],
    }
    assert voxels.tobytes() == array.astype(array.dtype.newbyteorder("<")).tobytes()


def test_the_header_says_what_labels_need(page):
    file = made_file(coded(), states_spacing=False, states_orientation=False, filled=(2, 3))
    header, _ = streamed(page, file)
    assert (header["states_spacing"], header["states_orientation"]) == (False, False)
    assert header["filled_slices"] == [2, 3]


@pytest.mark.parametrize(
    ("name", "notes"),
    [
        ("bool", []),
        ("float16", []),
        ("int64", ["voxels of type int64 are shown as float32"]),
        ("uint64", ["voxels of type uint64 are shown as float32"]),
    ],
)
def test_other_types_are_sent_as_one_that_is_known(page, name, notes):
    array = coded(dtype=np.uint8).astype(name)
    header, voxels = streamed(page, made_file(array, settled=False))
    assert header["dtype"] == ("uint8" if name == "bool" else "float32")
    assert header["notes"] == notes
    np.testing.assert_array_equal(voxels, array.astype(header["dtype"]))


@pytest.mark.parametrize(
    "laid_out",
    [
        np.asfortranarray,
        lambda array: np.ascontiguousarray(array.transpose(1, 0, 2)).transpose(1, 0, 2),
        lambda array: np.repeat(array, 2, axis=2)[:, :, ::2],
        lambda array: array.astype(array.dtype.newbyteorder(">")),
    ],
    ids=["i slowest", "j slowest", "with gaps", "of another byte order"],
)
def test_the_layout_in_memory_does_not_matter(page, laid_out):
    array = coded((40, 30, 50), np.int32)
    _, voxels = streamed(page, made_file(laid_out(array)))
    np.testing.assert_array_equal(voxels, array)


def test_no_second_copy_is_made():
    array = coded((600, 500, 4))
    pieces = list(volume_stream.pieces(array))
    assert max(map(len, pieces)) <= 1 << 20
    assert all(np.shares_memory(np.frombuffer(piece, np.uint8), array) for piece in pieces)
    assert sum(map(len, pieces)) == array.nbytes


@pytest.mark.parametrize("name", ["ct.nii", "ct.nii.gz", "ct.nrrd", "dicom"])
def test_files_arrive_as_they_are_read_otherwise(page, tmp_path, name):
    path = tmp_path / name
    if name == "dicom":
        path.mkdir()
        write_stack(path, coded((24, 20, 9)), oblique())
    else:
        write_any(Volume(coded((24, 20, 9)), world_from_index=oblique()), path)
    expected = read_volume(path)
    header, voxels = streamed(page, open_volume(path))
    assert header["name"] == name
    np.testing.assert_array_equal(header["world_from_index"], expected.world_from_index)
    assert header["dtype"] == expected.dtype.name
    np.testing.assert_array_equal(voxels, expected.array)


def test_a_head_request_waits_for_no_voxels(page):
    scene = ArrivingScene(made_file(coded(), lambda progress, filled: threading.Event().wait(60)))
    scene.stop = lambda: None
    with serving(page, scene) as client:
        answer = client.ask("data/volume", "HEAD")
    assert (answer.status, answer.body) == (200, b"")
    assert int(answer.headers["content-length"]) > coded().nbytes


# While it is read


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
    # Noise is not packed to nothing.
    array = np.random.default_rng(1).integers(0, 1000, (30, 64, 64), np.int16)
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
    assert len(told) > 1 or name == "ct.nii"


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


# What cannot be read


def fails(after):
    def load(progress, filled):
        voxels = np.ascontiguousarray(coded())
        if after:
            filled(voxels, after)
        raise FormatError("/somewhere/made.nrrd", "7 bytes", "120 bytes", "copy the file again")

    return load


def test_a_volume_that_breaks_off_is_noticed_and_explained(page):
    with serving(page, ArrivingScene(made_file(coded(), fails(after=2)))) as client:
        # The first request may come before or after the failure.
        broken = client.ask("data/volume")
        words = client.ask("data/problem")
        later = client.ask("data/volume")
        assert client.ask().status == 200
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
        assert client.ask("data/problem").status == 200
        connection.close()


def test_before_the_header_the_error_is_told_in_parts(page):
    with serving(page, ArrivingScene(made_file(coded(), fails(after=0), settled=False))) as client:
        answer = client.ask("data/volume")
    assert answer.status == 422
    assert answer.json == {
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
    assert words.startswith("ct.nii: found 465 bytes of voxels; expected 472 bytes")
    assert str(tmp_path) not in words


# Centerlines


def scene_of(volume, *centerlines, **chosen):
    return _scene(volume, centerlines, AS_WRITTEN | chosen)


def fetched(page, tmp_path, scene):
    with serving(page, scene) as client:
        answer = client.ask("data/centerlines")
    assert answer.status == 200, answer.body
    (tmp_path / "fetched.vtp").write_bytes(answer.body)
    return read_centerlines(tmp_path / "fetched.vtp")


def test_centerlines_come_back_to_the_bit(page, tmp_path):
    volume = write_volume(tmp_path / "ct.nii.gz")
    lines = write_lines(tmp_path / "lines.vtk")
    tree = fetched(page, tmp_path, scene_of(volume, lines))
    expected = read_centerlines(lines, volume=read_volume(volume))
    assert tree == expected


def test_the_volume_decides_their_space(page, tmp_path):
    volume = write_volume(tmp_path / "ct.nii.gz")
    lines = write_lines(tmp_path / "lines.vtk", bent_line() * (-1, -1, 1))
    with pytest.warns(match="25 in ras in mm"):
        tree = fetched(page, tmp_path, scene_of(volume, lines))
    np.testing.assert_allclose(tree.points, bent_line())


def test_options_decide_their_space_and_unit(page, tmp_path):
    volume = write_volume(tmp_path / "ct.nii.gz")
    lines = write_lines(tmp_path / "lines.vtk", bent_line() * (-0.1, -0.1, 0.1), radius=0.3)
    tree = fetched(page, tmp_path, scene_of(volume, lines, coordinates="ras", unit="cm"))
    np.testing.assert_allclose(tree.points, bent_line())


def test_several_files_are_one_tree_with_their_names(page, tmp_path):
    volume = write_volume(tmp_path / "ct.nii.gz")
    first = write_lines(tmp_path / "LAD.vtk")
    second = write_lines(tmp_path / "LCX.vtk", bent_line() + np.array([2, 0, 0]))
    tree = fetched(page, tmp_path, scene_of(volume, first, second))
    assert [vessel.name for vessel in tree] == ["LAD", "LCX"]


def test_centerlines_that_no_place_fits_do_not_keep_the_volume_from_being_shown(page):
    def tree_in(volume):
        raise FormatError("lines.vtk", "two spaces that fit", "one", "choose")

    with serving(page, ArrivingScene(made_file(coded()), tree_in)) as client:
        answer = client.ask("data/centerlines")
        assert client.ask("data/volume").status == 200
        assert client.ask("data/problem").status == 404
    assert (answer.status, answer.json["found"]) == (422, "two spaces that fit")
