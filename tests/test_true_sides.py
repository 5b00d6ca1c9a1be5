"""Sides, positions and angles in all outputs, checked with volumes whose values are coordinates."""

from __future__ import annotations

import functools
import json
import math
import re

import nibabel
import numpy as np
import pydicom
import pytest

import lumencut
from dicom_scenes import series
from label_reading import read_sides
from lumencut import Camera, Settings, Vessel, VesselTree, Volume, Window, read_centerlines, write_centerlines
from lumencut.cli.findings import orientation
from lumencut.pictures.hanging import HANGINGS, hanging_views
from lumencut.pictures.turntables import turntable
from lumencut.scene.orientation import c_arm_angles, view_name
from ramp_scenes import letters_of, oblique, ramp_volumes

#: The volumes lie elsewhere than the study into which the results are written.
pytestmark = pytest.mark.filterwarnings("ignore::lumencut.errors.StudyWarning")

BARE = Settings(context=None, silhouettes=False, window=Window(1000, 10))
#: Views by C-arm angles (degrees), and by a rotation of the picture.
VIEWS = [
    (0, 0, 0),
    (90, 0, 0),
    (180, 0, 0),
    (0, 90, 0),
    (-90, 0, 0),
    (30, 20, 0),
    (-45, -25, 0),
    (120, 10, 35),
]


def viewed(lao, cranial, turned=0, size=(240, 240)):
    """Return the view of a C-arm by its definition: angles above 0 are from the patient's left and head."""
    lao, cranial = math.radians(lao), math.radians(cranial)
    viewer = np.array(
        [math.sin(lao) * math.cos(cranial), -math.cos(lao) * math.cos(cranial), math.sin(cranial)]
    )
    up = np.array([-math.sin(lao) * math.sin(cranial), math.cos(lao) * math.sin(cranial), math.cos(cranial)])
    # If the top of the camera turns clockwise, the head moves counterclockwise in the picture.
    right = np.cross(-viewer, up)
    top = math.cos(math.radians(turned)) * up + math.sin(math.radians(turned)) * right
    return Camera((0, 0, 0), -viewer, top, size, 0.25)


def within(camera):
    """Return a straight vessel in the plane of a view, oblique in it: its cut surface is this plane."""
    way = camera.right_axis + 2 * camera.up
    return VesselTree([Vessel(np.linspace(-24, 24, 25)[:, None] * way / np.linalg.norm(way), 3.0)])


def shown(make):
    """Return the true position of every pixel, shown by a picture of each volume, (H, W, 3)."""
    return np.stack([make(volume).value for volume in ramp_volumes()], axis=-1)


def steps(places):
    """Return the mean change of true positions along rows and down columns, two arrays of shape (3,)."""
    return [np.nanmean(np.diff(places, axis=axis), axis=(0, 1)) for axis in (1, 0)]


@pytest.mark.parametrize("view", VIEWS)
def test_a_view_states_its_true_sides_and_angles(view, tmp_path):
    camera = viewed(*view)
    tree = within(camera)
    right, down = steps(shown(lambda volume: lumencut.render(volume, tree, camera, settings=BARE)))
    np.testing.assert_allclose(right / np.linalg.norm(right), camera.right_axis, atol=1e-3)
    frame = lumencut.render(ramp_volumes()[0], tree, camera, settings=BARE)
    expected = {"left": -right, "right": right, "top": -down, "bottom": down}
    assert read_sides(frame.annotated()) == {edge: letters_of(way) for edge, way in expected.items()}
    frame.save(tmp_path / "a.dcm", study=series())
    data = pydicom.dcmread(tmp_path / "a.dcm")
    assert list(data.PatientOrientation) == [
        letters_of(way).replace("S", "H").replace("I", "F") for way in (right, down)
    ]
    lao, cranial, turned = angles_of(view_name(camera))
    again = viewed(lao, cranial, turned)
    np.testing.assert_allclose(
        again.direction, np.cross(right, down) / np.linalg.norm(np.cross(right, down)), atol=0.02
    )
    np.testing.assert_allclose(again.up, -down / np.linalg.norm(down), atol=0.02)
    assert data.ImageComments.startswith(f"View {view_name(camera)}".replace("°", " deg"))


def angles_of(name):
    """Return LAO, cranial and rotation (degrees) from the name of a view."""
    known = {
        "anterior": (0, 0), "posterior": (180, 0), "left": (90, 0), "right": (-90, 0),
        "superior": (0, 90), "inferior": (0, -90),
    }  # fmt: skip
    found = {word: float(number) for word, number in re.findall(r"(LAO|RAO|CRA|CAU|turned) (-?\d+)", name)}
    word = name.split()[0]
    # The picture from above has the front on top; a C-arm view from there has the back on top.
    turned = found.get("turned", 0) + (180 if word == "superior" else 0)
    if word in known:
        return *known[word], turned
    lao = found.get("LAO", 0) - found.get("RAO", 0)
    return lao, found.get("CRA", 0) - found.get("CAU", 0), turned


@pytest.mark.parametrize("view", VIEWS)
def test_values_of_a_view_lie_in_their_true_directions(view, tmp_path):
    camera = viewed(*view)
    found = []
    for volume in ramp_volumes():
        path = tmp_path / f"{len(found)}.dcm"
        lumencut.render(volume, within(camera), camera, settings=BARE).save(path, values=True, study=series())
        data = pydicom.dcmread(path)
        stored = data.pixel_array.astype(float)
        value = stored * float(data.RescaleSlope) + float(data.RescaleIntercept)
        found.append(np.where(stored == data.PixelPaddingValue, np.nan, value))
    stated = np.reshape(data.ImageOrientationPatient, (2, 3)).astype(float)
    true = [step / float(data.PixelSpacing[0]) for step in steps(np.stack(found, axis=-1))]
    np.testing.assert_allclose(stated, true, atol=0.01)


@pytest.mark.parametrize("name", HANGINGS)
def test_hangings_are_what_they_are_called(name):
    for called, camera in hanging_views(name, (64, 64)):
        lao = re.search(r"(lao|rao)(\d+)", called)
        cranial = re.search(r"(cra|cau)(\d+)", called)
        degrees = [
            0 if one is None else int(one[2]) * (1 if one[1] in ("lao", "cra") else -1)
            for one in (lao, cranial)
        ]
        expected = viewed(*degrees)
        np.testing.assert_allclose(camera.direction, expected.direction, atol=1e-9)
        np.testing.assert_allclose(camera.up, expected.up, atol=1e-9)


def test_a_turntable_goes_to_the_left_of_the_patient():
    tree = within(viewed(0, 0))
    frames = turntable(lumencut.Renderer(ramp_volumes()[0], tree), None, BARE, 4, 360)
    assert [view_name(frame.camera) for frame in frames] == ["anterior", "left", "posterior", "right"]


def bow():
    """A vessel that bends in all directions."""
    t = np.linspace(-1, 1, 61)
    return Vessel(np.stack([12 * t**2 - 6, 8 * np.sin(2 * t), 24 * t], axis=1), 3.0)


TILTED = Camera.fitted(bow(), (0.4, 0.8, -0.2), (0.1, 0.0, 1.0), (240, 240))
MADE = {
    "projected": (lumencut.cpr, {"mode": "projected", "width": 50, "pixel_spacing": 0.2, "degrees": 25}),
    "stretched": (lumencut.cpr, {"mode": "stretched", "width": 50, "pixel_spacing": 0.2, "degrees": 25}),
    "straightened": (lumencut.cpr, {"mode": "straightened", "width": 50, "pixel_spacing": 0.2}),
    "tangential": (lumencut.cpr, {"mode": "tangential", "camera": TILTED}),
    "spiral": (lumencut.spiral, {"radius": 8.0, "pixel_spacing": 0.5}),
    "uncurl": (lumencut.uncurl, {"amount": 0.5, "width": 24, "pixel_spacing": 0.5}),
}


def flat(ahead):
    """Return a vector without its part along a direction."""
    ahead = np.array(ahead) / np.linalg.norm(ahead)
    return np.eye(3) - np.outer(ahead, ahead)


OPPOSITE = str.maketrans("RLAPIS", "LRPASI")
SEEN = {
    "tangential": flat(TILTED.direction),
    "projected": flat((-math.sin(math.radians(25)), math.cos(math.radians(25)), 0)),
}


@pytest.mark.parametrize("name", MADE)
def test_a_reformation_states_true_places_and_only_true_sides(name, tmp_path):
    make, how = MADE[name]
    made = make(ramp_volumes()[0], bow(), settings=BARE, **how)
    places = shown(lambda volume: make(volume, bow(), settings=BARE, **how))
    known = np.isfinite(places).all(axis=-1)
    assert known.sum() > 2000
    np.testing.assert_allclose(places[known], made.position[known], atol=1e-3)
    letters = {edge: word for edge, word in read_sides(made.annotated()).items() if word}
    made.save(tmp_path / "a.dcm", study=series())
    stated = pydicom.dcmread(tmp_path / "a.dcm").PatientOrientation
    assert bool(stated) == ({"right", "bottom"} <= letters.keys())
    for n, (axis, edges) in enumerate(((1, ("left", "right")), (0, ("top", "bottom")))):
        if edges[0] not in letters:
            assert edges[1] not in letters
            continue
        assert letters[edges[0]] == letters[edges[1]].translate(OPPOSITE)
        ways = np.diff(places, axis=axis)
        ways = ways[np.isfinite(ways).all(axis=-1)]
        # A camera or a projected CPR cannot show distances along the view, so they are left out.
        seen = ways @ SEEN[name] if name in SEEN else ways
        assert {letters_of(way) for way in seen[:: max(len(seen) // 500, 1)]} == {letters[edges[1]]}
        if stated:
            assert stated[n] == letters[edges[1]].replace("S", "H").replace("I", "F")


@pytest.mark.parametrize("ending", ["vtp", "vtk", "mrk.json", "csv", "swc"])
def test_centerlines_are_written_where_they_lie(ending, tmp_path):
    vessel = bow()
    path = tmp_path / f"a.{ending}"
    write_centerlines(VesselTree([vessel]), path)
    text = path.read_bytes().decode("utf-8", "replace")
    if ending == "mrk.json":
        curve = json.loads(text)["markups"][0]
        assert (curve["coordinateSystem"], curve["coordinateUnits"]) == ("LPS", "mm")
        points = np.array([one["position"] for one in curve["controlPoints"]])
    elif ending == "csv":
        header, *rows = [line.split(",") for line in text.splitlines()]
        columns = [header.index(f"{axis} (mm)") for axis in "lps"]
        points = np.array([[float(row[column]) for column in columns] for row in rows])
    elif ending == "swc":
        assert "LPS" in text.splitlines()[0]
        rows = [line.split() for line in text.splitlines() if not line.startswith("#")]
        points = np.array([[float(one) for one in row[2:5]] for row in rows])
    elif ending == "vtk":
        assert "SPACE=LPS" in text.splitlines()[1]
        start = text.splitlines().index(f"POINTS {len(vessel.points)} double") + 1
        rows = text.splitlines()[start : start + len(vessel.points)]
        points = np.array([[float(one) for one in row.split()] for row in rows])
    else:
        points = read_centerlines(path)[0].points
    sampled = np.stack([volume.sample(points) for volume in ramp_volumes()], axis=1)
    np.testing.assert_allclose(sampled, vessel.points, atol=1e-3)


@functools.cache
def tube():
    """A tube of 3 mm radius around the bow, on the oblique grid."""
    affine, size = oblique(), ramp_volumes()[0].size[0]
    index = np.stack(np.meshgrid(*[np.arange(size)] * 3, indexing="ij"), axis=-1)
    world = (index @ affine[:3, :3].T + affine[:3, 3]).reshape(-1, 3)
    away = np.full(len(world), np.inf)
    for point in bow().points:
        np.minimum(away, np.einsum("na,na->n", world - point, world - point), out=away)
    values = 400 / (1 + np.exp((np.sqrt(away) - 3) / 0.4))
    array = values.reshape((size,) * 3).T
    return Volume(np.ascontiguousarray(array, np.float32), world_from_index=affine)


@pytest.fixture(scope="module")
def profile():
    return lumencut.measure(tube(), bow())


def test_tables_say_where_sections_lie(profile, tmp_path):
    profile.save(tmp_path / "a.csv")
    profile.save(tmp_path / "a.json")
    header, *rows = [line.split(",") for line in (tmp_path / "a.csv").read_text().splitlines()]
    table = np.array([[float(row[header.index(f"center_{axis}_lps_mm")]) for axis in "xyz"] for row in rows])
    columns = json.loads((tmp_path / "a.json").read_text())["sections"]
    listed = np.array([columns[f"center_{axis}_lps_mm"] for axis in "xyz"], float).T
    for found in (table, listed):
        away = np.linalg.norm(found[5:-5, None] - bow().points, axis=2).min(axis=1)
        assert np.nanmax(away) < 0.6


def test_a_structured_report_has_true_coordinates(profile, tmp_path):
    pytest.importorskip("highdicom")
    middle = profile.arc_length[len(profile) // 2]
    profile.save(tmp_path / "a.dcm", study=series(), stenoses=[profile.stenosis(middle, middle / 2)])
    data = pydicom.dcmread(tmp_path / "a.dcm")
    kinds = {}
    for item in data.iterall():
        if item.keyword == "GraphicData":
            kinds.setdefault(len(item.value) // 3, []).append(np.reshape(item.value, (-1, 3)).astype(float))
    found = [points for several in kinds.values() for points in several]
    assert len(found) >= 3
    for points in found:
        away = np.linalg.norm(points[:, None] - bow().points, axis=2).min(axis=1)
        on_line, on_wall = away.max() < 0.6, np.abs(away - 3).max() < 0.6
        assert on_line or on_wall


def test_a_c_arm_shows_a_stretch_in_its_whole_length(profile):
    for start, end in ((5, 15), (20, 35), (40, 50)):
        ends = [bow().points[np.abs(arc(bow()) - at).argmin()] for at in (start, end)]
        for lao in (None, math.radians(20)):
            found = profile.c_arm(start, end, lao)
            camera = viewed(math.degrees(found.lao), math.degrees(found.cranial))
            along = np.subtract(*ends[::-1]) / np.linalg.norm(np.subtract(*ends))
            assert abs(along @ camera.direction) < 0.12
            words = re.sub("CRAN", "CRA", re.sub("CAUD", "CAU", str(found)))
            assert [part for part in words.split(" ") if part not in ("0°",)][1:]
            said = {word: float(number) for word, number in re.findall(r"(LAO|RAO|CRA|CAU) (\d+)", words)}
            called = {
                word: float(number)
                for word, number in re.findall(r"(LAO|RAO|CRA|CAU) (\d+)", c_arm_angles(camera))
            }
            assert {word: number for word, number in said.items() if number} == called


def arc(vessel):
    return np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(vessel.points, axis=0), axis=1))])


def test_info_names_each_axis_of_the_patient_once():
    random = np.random.default_rng(1)
    for _ in range(300):
        turn, _ = np.linalg.qr(random.normal(size=(3, 3)))
        affine = np.eye(4)
        affine[:3, :3] = turn * [0.5, 0.7, 2.0]
        letters = orientation(affine).split(",")[0]
        assert {"RLAPIS".index(letter) // 2 for letter in letters} == {0, 1, 2}
        sides = np.array(
            [np.eye(3)["RLAPIS".index(one) // 2] * (1 if one in "LPS" else -1) for one in letters]
        )
        assert np.sign(np.linalg.det(sides)) == np.sign(np.linalg.det(turn))
        # If the grid is nearly axis-aligned, nibabel says the same.
        if (np.abs(turn).max(axis=0) > 0.9).all():
            assert letters == "".join(nibabel.aff2axcodes(np.diag([-1, -1, 1, 1]) @ affine))


def test_the_wall_is_unrolled_from_its_true_side(profile):
    made = lumencut.lumen_map(tube(), bow(), profile=profile, pixel_spacing=0.5)
    straight = lumencut.cpr(tube(), bow(), "straightened", 10.0, 0.5)
    middle = (made.size[0] - 1) // 2
    for row in range(10, made.size[1] - 10, 12):
        at = made.arc_length[row]
        line = straight.world_from_pixel([[10, at / 0.5], [14, at / 0.5]])
        right = line[1] - line[0]
        along = np.diff(straight.world_from_pixel([[10, at / 0.5 - 1], [10, at / 0.5 + 1]]), axis=0)[0]
        out = made.position[row, middle] - line[0]
        turned = math.atan2(out @ np.cross(right, along) / np.linalg.norm(along), out @ right)
        expected = made.angle
        away = (turned - expected + math.pi) % (2 * math.pi) - math.pi
        assert abs(away) < 0.15, (row, turned, expected)


@pytest.mark.parametrize("found", ["trace", "trace_mask"])
def test_traced_lines_lie_in_their_vessel(found):
    scan = tube()
    if found == "trace":
        tree = lumencut.trace(scan, [bow().points[2], bow().points[-3]])
    else:
        tree = lumencut.trace_mask(Volume(scan.array > 200, world_from_index=scan.world_from_index))
    assert sum(vessel.length for vessel in tree) > 40
    away = np.linalg.norm(tree.points[:, None] - bow().points, axis=2).min(axis=1)
    # A line through a mask continues to the round end of its tube.
    assert np.quantile(away, 0.75) < 0.8
    assert away.max() < 3.5
