"""Labels and ``--like`` on the command line."""

from __future__ import annotations

import json

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image
from pydicom.valuerep import PersonName

from dicom_phantom import axial, images, save, single
from lumencut import Camera, Renderer, Settings, Window, read_centerlines, read_volume
from lumencut.cli import main
from lumencut.pictures.recipe import read_recipe
from scene_files import write_lines, write_volume


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    folder = tmp_path_factory.mktemp("scene")
    return write_volume(folder / "tube.nii.gz"), write_lines(folder / "line.vtk")


@pytest.fixture
def rendered(files, tmp_path):
    """Return a function that renders the tiny scene with options, and returns picture and messages."""

    def with_options(*more, output="out.png", code=0, command="render", lines=True):
        scene = files if lines else files[:1]
        path = tmp_path / output
        told = CliRunner().invoke(main, [command, *map(str, scene), "-o", str(path), *map(str, more)])
        assert told.exit_code == code, told.output
        return path, told.stderr

    return with_options


def pixels(path):
    with Image.open(path) as picture:
        return np.asarray(picture.convert("RGBA"))


def renderer(files):
    volume = read_volume(files[0])
    return Renderer(volume, read_centerlines(files[1], volume=volume))


SIZE = ("--size", "240x220")


def test_png_has_labels_and_other_files_have_none_unless_asked(rendered, files):
    scene = renderer(files)
    frame = scene.render(Camera.anterior(scene.tree, (240, 220)))
    labelled, bare = frame.annotated(), frame.image
    assert (labelled != bare).any()
    for output, options, expected in (
        ("out.png", (), labelled),
        ("out.PNG", (), labelled),
        ("out.png", ("--no-annotate",), bare),
        ("out.png", ("--annotate",), labelled),
        ("out.tif", (), bare),
        ("out.tif", ("--annotate",), labelled),
        ("out.tif", ("--vessel-names",), frame.annotated(vessel_names=True)),
    ):
        path, _ = rendered(*SIZE, *options, output=output)
        np.testing.assert_array_equal(pixels(path), expected)


def test_arrays_are_never_labelled(rendered, files):
    scene = renderer(files)
    path, _ = rendered(*SIZE, output="out.npz")
    with np.load(path) as arrays:
        np.testing.assert_array_equal(
            arrays["image"], scene.render(Camera.anterior(scene.tree, (240, 220))).image
        )


@pytest.mark.parametrize(
    ("options", "output", "lines", "said"),
    [
        (
            ("--no-annotate", "--vessel-names"),
            "out.png",
            True,
            "--vessel-names does nothing with --no-annotate",
        ),
        (("--vessel-names",), "out.png", False, "--vessel-names needs CENTERLINES"),
        (("--annotate",), "out.npz", True, "--annotate does nothing with .npz"),
        (("--vessel-names",), "out.npz", True, "--vessel-names does nothing with .npz"),
    ],
)
def test_labels_that_nothing_could_show_are_usage_errors(rendered, tmp_path, options, output, lines, said):
    _, told = rendered(*SIZE, *options, output=output, lines=lines, code=2)
    assert said in told
    assert list(tmp_path.iterdir()) == []


def test_too_small_a_picture_is_said_only_to_whoever_asked(rendered):
    assert rendered("--size", "199x300")[1] == ""
    _, told = rendered("--size", "199x300", "--annotate")
    assert told == ("lumencut: warning: no labels on 199 × 300 pixels: they need 200 on the shorter side\n")


VIEWS = [
    (),
    ("--view", "left", "--rotate", "33.3", "--tilt", "-12.7", "--zoom", "1.7"),
    ("--view", "1,2,-0.5", "--up", "0.1,0,1", "--center", "8,9,15", "--pixel-spacing", "0.123"),
    ("--window", "700/210", "--opacity", "50:150", "--context-transfer", "0:000000:0,300:ffeedd:0.4"),
    ("--paper", "--slab", "3:mean", "--background", "10203040", "--samples", "2"),
    ("--no-annotate", "--context", "mip"),
    ("--vessel-names", "--centerline-smoothing", "0.5"),
]


@pytest.mark.parametrize("options", VIEWS)
def test_like_renders_the_same_file_again(rendered, options):
    first, _ = rendered(*SIZE, *options, output="first.png")
    again, _ = rendered("--like", first, output="again.png")
    assert again.read_bytes() == first.read_bytes()


def test_like_without_centerlines(rendered):
    first, _ = rendered(*SIZE, "--context", "average", "--rotate", "20", output="first.png", lines=False)
    again, _ = rendered("--like", first, output="again.png", lines=False)
    assert again.read_bytes() == first.read_bytes()


def test_like_takes_the_window_although_other_centerlines_have_another(rendered, files, tmp_path):
    first, _ = rendered(*SIZE, output="first.png")
    other = write_lines(tmp_path / "short.vtk", [[4, 4, 4], [5, 5, 9]])
    told = CliRunner().invoke(
        main, ["render", str(files[0]), str(other), "-o", str(tmp_path / "o.png"), "--like", str(first)]
    )
    assert told.exit_code == 0
    assert read_recipe(tmp_path / "o.png") == read_recipe(first)


def test_options_beside_like_come_on_top(rendered):
    first, _ = rendered(*SIZE, "--rotate", "20", "--window", "700/210", "--levels", "3", output="first.png")
    before = read_recipe(first)

    def like(*options):
        return read_recipe(rendered("--like", first, *options, output="again.png")[0])

    assert like("--window", "500/100").settings.window == Window(level=100, width=500)
    assert like("--window", "500/100").settings.levels == 3
    assert like("--window", "500/100").camera == before.camera
    assert like("--paper").settings == Settings.paper(
        window=before.settings.window, context_window=before.settings.context_window, levels=3
    )
    assert like("--rotate", "5").camera == before.camera.rotated(degrees=5)
    assert like("--tilt", "5").camera == before.camera.rotated(degrees=-5, axis="right")
    assert like("--zoom", "2").camera == before.camera.zoomed(2)
    assert like("--pixel-spacing", "0.5").camera.pixel_spacing == 0.5
    assert like("--center", "1,2,3").camera.center.tolist() == [1, 2, 3]
    left = like("--view", "left").camera
    np.testing.assert_allclose(left.direction, [-1, 0, 0])
    assert (left.center == before.camera.center).all()
    assert left.pixel_spacing == before.camera.pixel_spacing
    np.testing.assert_allclose(like("--up", "0,0,-1").camera.up, [0, 0, -1], atol=1e-12)
    # Even a typed value that equals the default is an option of the user.
    assert like("--size", "768x768").camera.size == (768, 768)
    assert like("--no-annotate").annotate is False
    assert like("--vessel-names").vessel_names is True


def test_another_size_shows_all_that_was_in_view(rendered):
    first, _ = rendered(*SIZE, output="first.png")
    before = read_recipe(first).camera
    for size in ((480, 440), (100, 440), (2400, 220)):
        camera = read_recipe(
            rendered("--like", first, "--size", f"{size[0]}x{size[1]}", output="a.png")[0]
        ).camera
        shown = np.array(camera.size) * camera.pixel_spacing
        wanted = np.array(before.size) * before.pixel_spacing
        assert (shown >= wanted * (1 - 1e-12)).all()
        assert np.isclose(shown, wanted).any()


def test_like_refuses_other_pictures_before_it_reads_the_scene(rendered, tmp_path):
    Image.new("RGB", (300, 300)).save(tmp_path / "other.png")
    _, told = rendered("--like", tmp_path / "other.png", code=1)
    assert told.count("\n") == 1
    assert "without a description of its rendering" in told
    _, told = rendered("--like", tmp_path / "missing.png", code=1)
    assert "missing.png: found No such file" in told


def test_turntables_have_labels_on_request(rendered, tmp_path):
    few = (*SIZE, "--frames", "2")
    bare, _ = rendered(*few, output="bare", command="turntable")
    named, _ = rendered(*few, "--annotate", output="named", command="turntable")
    moving, _ = rendered(*few, "--vessel-names", output="moving.png", command="turntable")
    for number in range(2):
        name = f"frame-00{number}.png"
        assert (pixels(bare / name) != pixels(named / name)).any()
        assert not read_recipe(bare / name).annotate
        again, _ = rendered("--like", named / name, output="again.png")
        np.testing.assert_array_equal(pixels(again), pixels(named / name))
    with Image.open(moving) as first:
        assert np.asarray(first.convert("RGB")).shape == (220, 240, 3)
        assert (np.asarray(first.convert("RGB")) != pixels(bare / "frame-000.png")[..., :3]).any()


def test_the_text_of_a_picture_from_dicom_has_no_text_of_a_header(tmp_path):
    folder = tmp_path / "JANE"
    folder.mkdir()
    words = set()
    for number, image in enumerate(images(axial()), 1):
        data = single(image, number)
        data.PatientName, data.PatientID = "DOE^JANE", "4711-MRN"
        data.InstitutionName, data.StudyDescription = "Mercy Hospital", "CTA runoff"
        save(data, folder / f"{number}.dcm")
        values = (element.value for element in data if element.keyword != "PixelData")
        words |= {str(value) for value in values if isinstance(value, (str, PersonName)) and len(value) > 3}
    told = CliRunner().invoke(main, ["render", str(folder), "-o", str(tmp_path / "out.png"), *SIZE])
    assert told.exit_code == 0, told.output
    assert {"DOE^JANE", "4711-MRN", "20260101", "Mercy Hospital"} <= words
    assert len(words) > 10
    with Image.open(tmp_path / "out.png") as picture:
        text = json.dumps(picture.info)
    assert b"pHYs" in (tmp_path / "out.png").read_bytes()
    assert [word for word in words | {str(tmp_path), "JANE", "dcm"} if word in text] == []
