"""Chosen vessels in front of all others: names and ids, what they show, and errors."""

import numpy as np
import pytest
from click.testing import CliRunner

from lumencut import (
    Camera,
    Focus,
    Renderer,
    Settings,
    SettingsError,
    VesselTreeError,
    cfa,
    cpr,
    cr,
    mpcpr,
    phantom,
    write_centerlines,
)
from lumencut.cli import main
from lumencut.cli.settings import settings_from
from lumencut.pictures.recipe import read_recipe
from scene_files import write_volume_of


@pytest.fixture(scope="module")
def scene() -> phantom.Phantom:
    """Two tubes; in the view "front" crosses in front of "back"."""
    return phantom.crossing()


@pytest.fixture(scope="module")
def renderer(scene: phantom.Phantom) -> Renderer:
    return Renderer(scene.volume, scene.tree, device="cpu")


@pytest.fixture(scope="module")
def camera(scene: phantom.Phantom) -> Camera:
    return Camera.anterior(scene.tree, size=(120, 120))


def test_a_vessel_behind_another_is_seen_where_it_is_chosen(renderer: Renderer, camera: Camera) -> None:
    plain = renderer.render(camera, Settings(depth_filter=False))
    chosen = renderer.render(camera, Settings(depth_filter=False, focus_vessels=["back"]))
    middle = (60, 60)
    assert (plain.vessel[middle], chosen.vessel[middle]) == (0, 1)
    assert chosen.depth[middle] - plain.depth[middle] == pytest.approx(20, abs=1e-3)
    alone = renderer.with_tree(renderer.tree.select("back")).render(camera, Settings(depth_filter=False))
    x = np.arange(120) - 59.5
    of_back = np.abs(x) * camera.pixel_spacing < 3.9
    assert (chosen.value[60, of_back] == alone.value[60, of_back]).all()
    assert (chosen.image[..., 1] != plain.image[..., 1]).any()


def test_names_ids_and_words_of_digits_are_the_same_vessels(renderer: Renderer, camera: Camera) -> None:
    found = [
        renderer.render(camera, Settings(focus_vessels=words)).image
        for words in (("back",), [1], (np.int64(1),), ("1",), [-1], ("back", 1))
    ]
    assert all((image == found[0]).all() for image in found)
    assert Settings(focus_vessels=["back", np.int64(1)]).focus_vessels == ("back", 1)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["bakc"], "perhaps 'back' is meant"),
        (["aorta"], r"vessel 'aorta': found no vessel of this name; expected one of 'front', 'back'"),
        ([2], "found 2 in a tree of 2 vessels"),
    ],
)
def test_unknown_vessels_are_refused(
    renderer: Renderer, camera: Camera, words: list[str | int], message: str
) -> None:
    with pytest.raises(VesselTreeError, match=message):
        renderer.render(camera, Settings(focus_vessels=words))
    with pytest.raises(VesselTreeError, match=message):
        renderer.cut_surface(camera, Settings(focus_vessels=words))


@pytest.mark.parametrize("words", ["back", 1, None, [1.5], [True], [None]])
def test_what_is_no_list_of_vessels_is_refused(words: object) -> None:
    with pytest.raises(SettingsError, match=r"focus_vessels: found .*; expected several ids and names"):
        Settings(focus_vessels=words)  # type: ignore[arg-type]


def test_tiers_and_centerlines_are_needed(scene: phantom.Phantom, camera: Camera) -> None:
    with pytest.raises(SettingsError, match="chosen vessels without lumen_first"):
        Settings.paper(focus_vessels=[1])
    without = Renderer(scene.volume, None, device="cpu")
    for words in (["back"], [1]):
        with pytest.raises(SettingsError, match="chosen vessels for a scene without centerlines"):
            without.render(camera, Settings(focus_vessels=words))


@pytest.mark.parametrize("setting", [{"focus": Focus(2, 6)}, {"focus_vessels": ["back"]}])
def test_other_pictures_refuse_a_focus(
    scene: phantom.Phantom, camera: Camera, setting: dict[str, object]
) -> None:
    (name,), settings = setting, Settings(**setting)  # type: ignore[arg-type]
    what = {"focus": "a focus", "focus_vessels": "chosen vessels"}[name]
    message = f"{name}: found {what} for a picture that is not a cut surface; .*leave the {name} out"
    tree, vessel = scene.tree, scene.tree["back"]
    for picture in (
        lambda: mpcpr(scene.volume, tree, camera, settings, device="cpu"),
        lambda: cr(scene.volume, tree, camera, settings, device="cpu"),
        lambda: cpr(scene.volume, vessel, settings=settings, device="cpu"),
        lambda: cfa(scene.volume, vessel, settings=settings, device="cpu"),
    ):
        with pytest.raises(SettingsError, match=message):
            picture()


def test_a_picture_says_ids_and_no_names(renderer: Renderer, camera: Camera, tmp_path) -> None:
    renderer.render(camera, Settings(focus_vessels=["back"])).save(tmp_path / "view.png")
    assert read_recipe(tmp_path / "view.png").settings.focus_vessels == (1,)
    assert b'"back"' not in (tmp_path / "view.png").read_bytes()


def test_the_command_line_takes_several(scene: phantom.Phantom, tmp_path) -> None:
    assert settings_from({"focus_vessels": ("back", "0")}).focus_vessels == ("back", "0")
    assert settings_from({"focus_vessels": ()}).focus_vessels == ()
    files = [str(tmp_path / "ct.nii"), str(tmp_path / "lines.vtp")]
    write_volume_of(scene.volume, tmp_path / "ct.nii")
    write_centerlines(scene.tree, files[1])
    picture = str(tmp_path / "view.png")
    command = ["render", *files, "-o", picture, "--size", "96x96", "--focus-vessels"]
    result = CliRunner().invoke(main, [*command, "back"])
    assert result.exit_code == 0, result.output
    result = CliRunner().invoke(main, [*command, "bakc"])
    assert result.exit_code != 0
    assert "perhaps 'back' is meant" in result.output
    result = CliRunner().invoke(main, [*command, "back", "--others-strength", "0.2"])
    assert "--others-strength does nothing without a focus" in result.output
