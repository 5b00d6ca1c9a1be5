"""``--like`` and labels with several views, files, chosen vessels, named windows and a settings file."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

from lumencut import Camera, Renderer, Settings, Vessel, VesselTree, read_centerlines, read_volume
from lumencut.cli import main
from lumencut.files.centerline_writers import write_centerlines
from lumencut.pictures.picture_text import KEYWORD
from lumencut.pictures.recipe import read_recipe
from scene_files import bent_line, write_volume

SIZE = ("--size", "240x220")


@dataclass
class Scene:
    """Return a function that renders a volume along two files with one vessel each."""

    folder: Path
    volume: Path
    lines: list[Path]

    def render(self, *more, output="out.png", code=0):
        path = self.folder / output
        words = ["render", self.volume, *self.lines, "-o", path, *more]
        told = CliRunner().invoke(main, [str(word) for word in words])
        assert told.exit_code == code, told.output
        return path, told.stderr

    def written(self):
        return sorted(path.name for path in self.folder.iterdir())


@pytest.fixture
def scene(tmp_path):
    points = bent_line()
    lines = []
    for name, part in (("LAD", points[:14]), ("LCX", points[13:])):
        lines.append(tmp_path / f"{name}.csv")
        write_centerlines(VesselTree([Vessel(part, 3.0)]), lines[-1])
    (tmp_path / "out").mkdir()
    return Scene(tmp_path / "out", write_volume(tmp_path / "ct.nii.gz"), lines)


def pixels(path):
    with Image.open(path) as picture:
        return np.asarray(picture.convert("RGBA"))


def test_every_output_of_every_view_has_its_own_labels(scene):
    views = ("--view", "left", "--view", "0,1,-0.5")
    scene.render(*SIZE, *views, "--vessel-names", "-o", scene.folder / "{view} again.png", output="out.png")
    renderer = Renderer(read_volume(scene.volume), read_centerlines(scene.lines, "lps"))
    seen = []
    for name in ("left", "0_1_-0.5"):
        recipe = read_recipe(scene.folder / f"out-{name}.png")
        frame = renderer.render(recipe.camera, recipe.settings)
        labelled = frame.annotated(vessel_names=True)
        assert (labelled != frame.image).any()
        for path in (f"out-{name}.png", f"{name} again.png"):
            np.testing.assert_array_equal(pixels(scene.folder / path), labelled)
        seen.append(labelled)
    assert (seen[0] != seen[1]).any()


def test_each_of_several_views_can_be_rendered_again_by_itself(scene):
    scene.render(*SIZE, "--view", "left", "--view", "superior", "--zoom-to", "LCX", output="{view}.png")
    for name in ("left", "superior"):
        again, _ = scene.render("--like", scene.folder / f"{name}.png", output="again.png")
        assert again.read_bytes() == (scene.folder / f"{name}.png").read_bytes()


def test_like_takes_one_view_at_most(scene):
    first, _ = scene.render(*SIZE, "--rotate", "20", output="first.png")
    _, told = scene.render("--like", first, "--view", "left", "--view", "right", output="two.png", code=2)
    assert "--view is given 2 times with --like" in told
    assert scene.written() == ["first.png"]
    scene.render("--like", first, "--view", "left", output="see {view}.png")
    assert scene.written() == ["first.png", "see left.png"]
    np.testing.assert_allclose(read_recipe(scene.folder / "see left.png").camera.direction, [-1, 0, 0])


def test_the_view_of_a_picture_has_no_name(scene):
    first, _ = scene.render(*SIZE, output="first.png")
    _, told = scene.render("--like", first, output="{view}.png", code=2)
    assert "give --view with --like, or another name" in told
    assert scene.written() == ["first.png"]


@pytest.mark.parametrize(
    ("choice", "shown"), [(("--vessel", "LAD"), 1), (("--exclude", "0"), 1), (("--vessel", "0"), 1), ((), 2)]
)
def test_chosen_vessels_are_given_again(scene, choice, shown):
    first, told = scene.render(*SIZE, *choice, "--vessel-names", output="first.png")
    assert told == ""
    assert read_recipe(first).vessels == shown
    again, told = scene.render("--like", first, *choice, output="again.png")
    assert told == ""
    assert again.read_bytes() == first.read_bytes()
    with Image.open(first) as picture:
        assert not any(name in picture.info[KEYWORD] for name in ("LAD", "LCX"))


def test_another_number_of_vessels_is_told(scene):
    first, _ = scene.render(*SIZE, "--vessel", "LAD", output="first.png")
    other, told = scene.render("--like", first, output="again.png")
    assert told == (
        f"lumencut: warning: {first} shows 1 vessel, the new picture 2; "
        "--vessel and --exclude choose vessels, also with --like\n"
    )
    assert scene.render("--like", first, "--exclude", "LAD", "--zoom-to", "LCX", output="third.png")[1] == ""
    assert scene.render("--like", other, "--vessel", "LAD", output="third.png")[1] == ""
    assert read_recipe(other).camera == read_recipe(first).camera
    assert (pixels(other) != pixels(first)).any()


def test_zoom_to_fits_the_view_of_a_picture_anew(scene):
    first, _ = scene.render(*SIZE, "--view", "left", "--rotate", "20", output="first.png")
    before = read_recipe(first).camera
    tree = read_centerlines(scene.lines, "lps")
    fitted = Camera.fitted(tree["LCX"], before.direction, before.up, before.size)
    for more, expected in (((), fitted), (("--zoom", "2"), fitted.zoomed(2))):
        path, _ = scene.render("--like", first, "--zoom-to", "LCX", *more, output="again.png")
        camera = read_recipe(path).camera
        np.testing.assert_allclose(camera.center, expected.center, atol=1e-9)
        assert camera.pixel_spacing == pytest.approx(expected.pixel_spacing)


@pytest.mark.parametrize("name", ["cta", "mra", "full", "auto"])
def test_named_windows_are_stored_as_they_were_used(scene, name):
    windows = ("--window", name, "--context-window", name)
    first, _ = scene.render(*SIZE, *windows, output="first.png")
    used = Renderer(read_volume(scene.volume), read_centerlines(scene.lines, "lps")).windowed(
        Settings(window=name, context_window=name)
    )
    assert read_recipe(first).settings == used
    again, _ = scene.render("--like", first, output="again.png")
    assert again.read_bytes() == first.read_bytes()


def test_a_name_beside_like_is_taken_from_the_new_volume(scene):
    first, _ = scene.render(*SIZE, "--window", "700/210", output="first.png")
    path, _ = scene.render("--like", first, "--window", "full", output="again.png")
    window = read_recipe(path).settings.window
    assert (window.level, window.width) == (170, 260)


def test_settings_as_a_file_and_like_exclude_each_other(scene, tmp_path):
    look = tmp_path / "look.toml"
    Settings(window="mra", levels=2).save(look)
    first, _ = scene.render(*SIZE, "--settings", look, output="first.png")
    _, told = scene.render("--like", first, "--settings", look, output="again.png", code=2)
    assert "--settings and --like exclude each other: both name all settings" in told
    assert scene.written() == ["first.png"]
    again, _ = scene.render("--like", first, output="again.png")
    assert again.read_bytes() == first.read_bytes()
    assert read_recipe(again).settings.levels == 2
