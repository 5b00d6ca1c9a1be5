"""Session files of the viewer: their vessels, view and marks on the command line."""

import json
import warnings

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

from lumencut import (
    Camera,
    FormatError,
    Renderer,
    Settings,
    TransferFunction,
    Window,
    measure,
    phantom,
    read_centerlines,
    read_volume,
    write_centerlines,
)
from lumencut.cli import main
from lumencut.viewer.session_file import is_session_file, read_session
from scene_files import write_volume_of

CAMERA = {
    "center": [0.0, 0.0, 0.0],
    "direction": [0.0, 1.0, 0.0],
    "up": [0.0, 0.0, 1.0],
    "size": [160, 120],
    "pixel_spacing": 0.6,
}
POINTS = [[100.0, [9, 200, 30], 0.0], [300.0, [255, 255, 255], 0.3]]
VIEW = {
    "camera": CAMERA,
    "method": "csr",
    "settings": {
        "window": [250.0, 700.0],
        "context": "mip",
        "context_window": [200.0, 800.0],
        "context_transfer": POINTS,
    },
    "layout": "strip",
    "cross_hair": None,
    "picked": None,
}
MARKS = {
    "at_mm": 30.0,
    "references_mm": [50.0],
    "method": "nascet",
    "original_mm": None,
    "comparison_mm": None,
    "group": None,
    "stretch_mm": None,
    "second_stretch_mm": None,
}


def write_session(path, tree, view=VIEW, hidden=(), marks=None, fwhm=None, **more):
    """Write a session file as the viewer does: markups with an additional field."""
    write_centerlines(tree, path)
    vessels = [
        {
            "color": "#1177aa",
            "hidden": number in hidden,
            "clicks": None,
            "confidence": None,
            "bridged": None,
            "marks": marks if number == 0 else None,
        }
        for number in range(len(tree))
    ]
    session = {
        "format": 1,
        "software": "lumencut 0",
        "notice": "Lumencut is not a medical device.",
        "scan": None,
        "vessels": vessels,
        "doubtful": [],
        "stoppers": [],
        "bridge": False,
        "rulers": [],
        "fwhm_mm": fwhm,
        "view": view,
    } | more
    content = json.loads(path.read_text()) | {"LumencutSession": session}
    path.write_text(json.dumps(content))
    return path


def scan_of(volume, shift=0.0, every=1):
    """Return the grid of a volume as the viewer saves it, moved along x (mm); for 2, every second voxel."""
    rows = (volume.world_from_index * ([every] * 3 + [1])).tolist()
    rows[0][3] += shift
    return {"size": [-(-n // every) for n in volume.size], "world_from_index": rows}


@pytest.mark.parametrize(
    ("scan", "is_said"),
    [({}, False), ({"every": 2}, False), ({"shift": 1e-4}, False), ({"shift": 30.0}, True)],
)
def test_a_session_of_another_scan_is_said(tmp_path, scan, is_said):
    scene = phantom.y_junction()
    session = write_session(tmp_path / "a.mrk.json", scene.tree, scan=scan_of(scene.volume, **scan))
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        read_centerlines(session, volume=scene.volume)
    assert ["a session of another scan" in str(one.message) for one in caught] == [True] * is_said
    assert {one.filename for one in caught} == {__file__} if is_said else not caught
    volume = write_volume_of(scene.volume, tmp_path / "ct.nii.gz")
    done = run("measure", volume, session, "-o", tmp_path / "a.csv", "--step", 5, "--fwhm", 0.9)
    assert done.exit_code == 0, done.output
    assert ("a session of another scan" in " ".join(done.output.split())) is is_said


@pytest.fixture(scope="module")
def branches(tmp_path_factory):
    """Three vessels that meet, and a session in which one of them is hidden."""
    folder, scene = tmp_path_factory.mktemp("branches"), phantom.y_junction()
    volume = write_volume_of(scene.volume, folder / "ct.nii.gz")
    return volume, write_session(folder / "saved.mrk.json", scene.tree, hidden=(2,)), scene.tree


def run(*words):
    return CliRunner().invoke(main, [*map(str, words)])


def pixels(path):
    with Image.open(path) as picture:
        return np.asarray(picture.convert("RGBA"))


def test_its_vessels_are_centerlines(branches):
    read = read_centerlines(branches[1])
    assert len(read) == len(branches[2])
    for found, vessel in zip(read, branches[2], strict=True):
        np.testing.assert_array_equal(found.points, vessel.points)


def test_what_stands_beside_the_vessels(branches):
    session = read_session(branches[1])
    assert is_session_file(branches[1])
    assert session.hidden == (2,)
    assert session.recipe.vessels == 2
    settings = Settings(
        window=Window(250, 700),
        context="mip",
        context_window=Window(200, 800),
        context_transfer=TransferFunction(POINTS),
    )
    assert session.recipe.settings == settings
    assert session.recipe.camera == Camera(**{**CAMERA, "size": (160, 120)})


def test_like_a_session_renders_its_vessels_in_its_view(branches, tmp_path):
    volume, session, tree = branches
    result = run("render", volume, "-o", tmp_path / "like.png", "--like", session, "--no-annotate")
    assert result.exit_code == 0, result.output
    shown = read_session(session).recipe
    frame = (
        Renderer(read_volume(volume), tree).with_tree(tree.select(0, 1)).render(shown.camera, shown.settings)
    )
    np.testing.assert_array_equal(pixels(tmp_path / "like.png"), frame.image)


def test_options_beside_a_session_come_on_top(branches, tmp_path):
    volume, session, tree = branches
    words = ("--like", session, "--vessel", "2", "--no-annotate")
    result = run("render", volume, session, "-o", tmp_path / "hidden.png", *words)
    assert result.exit_code == 0, result.output
    shown = read_session(session).recipe
    frame = Renderer(read_volume(volume), tree).with_tree(tree.select(2)).render(shown.camera, shown.settings)
    np.testing.assert_array_equal(pixels(tmp_path / "hidden.png"), frame.image)


def test_measure_grades_what_was_marked_in_the_viewer(tmp_path):
    scene = phantom.stenosis(60)
    volume = write_volume_of(scene.volume, tmp_path / "ct.nii.gz")
    session = write_session(tmp_path / "saved.mrk.json", scene.tree, marks=MARKS, fwhm=0.9)
    result = run("measure", volume, session, "-o", tmp_path / "out.json", "--step", 2)
    assert result.exit_code == 0, result.output
    stenosis = json.loads((tmp_path / "out.json").read_text())["vessels"][0]["stenosis"]
    expected = measure(read_volume(volume), scene.tree[0], 2.0, 0.9, tree=scene.tree).stenosis(30.0, 50.0)
    assert (stenosis["percent"], stenosis["at_mm"]) == (expected.percent, 30.0)
    result = run("measure", volume, session, "-o", tmp_path / "other.json", "--at", 20, "--step", 5)
    assert json.loads((tmp_path / "other.json").read_text())["vessels"][0]["stenosis"] is None


def test_measure_says_where_a_line_was_moved_in_the_viewer(tmp_path):
    scene = phantom.stenosis(60)
    volume = write_volume_of(scene.volume, tmp_path / "ct.nii.gz")
    session = write_session(tmp_path / "saved.mrk.json", scene.tree, marks=MARKS, fwhm=0.9, format=2)
    content = json.loads(session.read_text())
    places = np.linalg.norm(scene.tree[0].points - scene.tree[0].points[0], axis=1)
    moved = [bool(10 <= place <= 20) for place in places]
    content["LumencutSession"]["vessels"][0]["by_hand"] = moved
    session.write_text(json.dumps(content))
    result = run("measure", volume, session, "-o", tmp_path / "out.json", "--step", 2)
    assert result.exit_code == 0, result.output
    vessel = json.loads((tmp_path / "out.json").read_text())["vessels"][0]
    flagged = ["line by hand" in flags for flags in vessel["sections"]["flags"]]
    assert flagged == [10 <= place <= 20 for place in vessel["sections"]["arc_length_mm"]]
    content["LumencutSession"]["vessels"][0]["by_hand"] = moved[:-1]
    session.write_text(json.dumps(content))
    with pytest.raises(FormatError, match="points by hand of vessel 0"):
        read_session(session)


def test_measure_reckons_with_the_point_spread_that_was_given_in_the_viewer(tmp_path):
    scene = phantom.stenosis(60)
    volume = write_volume_of(scene.volume, tmp_path / "ct.nii.gz")
    session = write_session(tmp_path / "saved.mrk.json", scene.tree, fwhm=0.9)
    for words, expected in (((), 0.9), (("--fwhm", 0.7), 0.7)):
        result = run("measure", volume, session, "-o", tmp_path / "out.json", "--step", 5, *words)
        assert result.exit_code == 0, result.output
        assert f"FWHM {expected:.2f} mm given" in result.output


def test_a_session_with_an_assumed_millimetre_is_read_and_one_of_the_future_is_refused(branches, tmp_path):
    path, tree = tmp_path / "saved.mrk.json", branches[2]
    write_session(path, tree, hidden=(2,), format=2, one_millimetre_assumed=True)
    assert read_session(path).hidden == (2,)
    write_session(path, tree, format=3)
    with pytest.raises(FormatError, match=r"found version 3; expected version 1 or 2.*newer version"):
        read_session(path)


def test_markups_of_others_are_no_sessions(branches, tmp_path):
    path = tmp_path / "lines.mrk.json"
    write_centerlines(branches[2], path)
    assert not is_session_file(path)
    with pytest.raises(FormatError, match="found no field LumencutSession"):
        read_session(path)


@pytest.mark.parametrize(
    ("view", "found"),
    [
        ({**VIEW, "method": "mpcpr"}, "a view by the method mpcpr"),
        ({**VIEW, "settings": {"levels": 99}}, "a view that cannot be rendered"),
        ({**VIEW, "settings": {"context_transfer": [[1.0]]}}, "a view that cannot be rendered"),
        ({**VIEW, "settings": {"no_such": 1}}, "a view that cannot be rendered"),
        ({**VIEW, "camera": {**CAMERA, "pixel_spacing": -1}}, "a view that cannot be rendered"),
        ({**VIEW, "patient": "Doe"}, "unknown field"),
        (None, "a session without a view"),
    ],
)
def test_views_that_cannot_be_rendered_are_refused(branches, tmp_path, view, found):
    path = write_session(tmp_path / "odd.mrk.json", branches[2], view=view)
    result = run("render", branches[0], "-o", tmp_path / "out.png", "--like", path)
    assert result.exit_code != 0
    assert found in result.output
    assert not (tmp_path / "out.png").exists()
