"""The viewer's server: the page, the stream of the volume, and the centerlines."""

import threading

import numpy as np
import pytest

from lumencut import FormatError, Volume, read_centerlines, read_volume
from lumencut.cli.view import _scene
from lumencut.files.volume_writers import write_volume as write_any
from lumencut.files.volumes import open_volume
from lumencut.viewer import volume_stream
from lumencut.viewer.arriving import ArrivingScene
from lumencut.viewer.page import Page
from lumencut.viewer.server import ViewerServer
from scene_files import bent_line, write_lines, write_volume
from view_serving import SCRIPT, SERVED, made_file, serving, split, write_page
from volume_samples import coded, oblique, write_stack

SENT_ALIKE = ["int8", "uint8", "int16", "uint16", "int32", "uint32", "float32", "float64"]
AS_WRITTEN = {"coordinates": None, "unit": None, "reorder": False, "series": None, "phase": None}
AS_WRITTEN |= {"fill_gaps": False, "resample_slices": False}
SCAN = ("series_number", "series_description", "phase", "slice_thickness_mm", "kernel")


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


def test_the_page_is_served_as_it_was_built(page):
    with serving(page) as client:
        index, script, wasm = (client.ask(name) for name in ("", "assets/app.js", "assets/core.wasm"))
    assert (index.status, index.body.decode()) == (200, SERVED)
    assert index.headers["content-type"] == "text/html; charset=utf-8"
    assert (script.status, script.body) == (200, SCRIPT)
    assert script.headers["content-type"] == "text/javascript; charset=utf-8"
    assert wasm.headers["content-type"] == "application/wasm"


def test_a_query_belongs_to_the_page(page):
    with serving(page) as client:
        assert client.ask("?volume=data/volume").body.decode() == SERVED


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


def test_a_server_that_ends_by_itself_is_an_error(page):
    with ViewerServer(Page.of(page)) as server:
        server._server.should_exit = True
        with pytest.raises(RuntimeError, match="ended by itself"):
            server.wait()


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
        "has_study": False,
        "identity": {"patient": "", "issuer": "", "modality": ""},
        "scan": dict.fromkeys(SCAN),
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
    asked = threading.Event()
    scene = ArrivingScene(made_file(coded(), lambda progress, filled: asked.wait(60)))
    scene.stop = lambda: None
    with serving(page, scene) as client:
        answer = client.ask("data/volume", "HEAD")
    # If reading continued, it would change the handling of warnings in later tests.
    asked.set()
    scene._thread.join(10)
    assert not scene._thread.is_alive()
    assert (answer.status, answer.body) == (200, b"")
    assert int(answer.headers["content-length"]) > coded().nbytes


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
        assert split(client.ask("data/volume").body)[1] == coded().tobytes()
        assert client.ask("data/problem").status == 404
    assert (answer.status, answer.json["found"]) == (422, "two spaces that fit")
