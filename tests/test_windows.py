"""Windows computed from every kind of angiography, and named windows."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from conftest import needs_shared_data
from lumencut import (
    Camera,
    Renderer,
    Settings,
    SettingsError,
    Vessel,
    VesselTree,
    Volume,
    VolumeError,
    Window,
    _lumencut,
    phantom,
    read_centerlines,
    read_volume,
    write_centerlines,
)
from lumencut.cli import main
from lumencut.cli.parameters import WINDOW_NAMES as CLI_NAMES
from lumencut.pictures.recipe import read_recipe
from lumencut.scene.window import WINDOW_NAMES
from window_measures import background, contrast, share, shares
from window_scenes import FAT, KINDS, SOFT, angiography, tree

ROOT = Path(__file__).resolve().parent.parent
BRIGHT = [name for name, kind in KINDS.items() if not kind.is_dark]
#: CT angiographies whose voxels hold fat and air.
WITH_FAT = [
    name
    for name in BRIGHT
    if name.startswith("CTA") and not any(without in name for without in ("lumen", "vessels", "body"))
]
MASKED = [name for name in BRIGHT if "alone" in name or "zeros" in name or " at " in name]
DARK = [name for name, kind in KINDS.items() if kind.is_dark]

REAL = {
    "stent": ("stent-cta/stent_cta.nii.gz", "stent-cta/centerlines.vtp"),
    "dissection": ("dissection-cta/ct_cropped.nii.gz", "dissection-cta/aorta_arch_centerlines_LPS.vtp"),
    "contrast MRA": ("aorta-mra/aorta.mha", "aorta-mra/aorta_full_centerlines_LPS.vtp"),
}


def ends(window):
    return window.level - window.width / 2, window.level + window.width / 2


@pytest.mark.parametrize("name", BRIGHT)
def test_along_centerlines_the_lumen_is_light_and_its_tissue_dark(name):
    scene = angiography(name)
    found = shares(scene, Window.from_data(scene.volume, scene.tree))
    lumen = scene.volume.sample(np.concatenate([vessel.points for vessel in scene.tree]))
    window = Window.from_data(scene.volume, scene.tree)
    assert 0.60 - 1e-6 <= share(window, lumen[np.isfinite(lumen)]) <= 0.72 + 1e-6
    assert 0.58 <= found["centerline"] <= 0.75
    # NaN if only the vessels have finite values.
    assert not found["tissue"] >= 0.40
    assert name == "CTA, lumen in NaN" or found["tissue"] < 0.40


@pytest.mark.parametrize("name", WITH_FAT)
def test_along_centerlines_of_a_ct_fat_is_above_black(name):
    scene = angiography(name)
    window = Window.from_data(scene.volume, scene.tree)
    fat = share(window, scene.array[scene.labels == FAT])
    assert 0.01 < fat < 0.25
    # There is also soft tissue; more than half of it is brighter.
    assert share(window, scene.array[scene.labels == SOFT]) > fat + 0.05


@pytest.mark.parametrize("name", KINDS)
def test_no_window_from_the_data_begins_below_the_smallest_value(name):
    scene = angiography(name)
    volume = scene.volume
    smallest = float(np.nanmin(scene.array))
    for window in (
        Window.from_data(volume, scene.tree),
        Window.from_data(volume),
        Window.for_mip(volume),
        Window.whole(volume),
        Window.named("mra", volume),
    ):
        assert ends(window)[0] >= smallest - 1e-9 * window.width


@pytest.mark.parametrize("has_tree", [False, True])
@pytest.mark.parametrize("name", MASKED)
def test_the_background_of_a_masked_angiography_is_black_in_a_mip(name, has_tree):
    scene = angiography(name)
    window = Renderer(scene.volume, scene.tree if has_tree else None).windowed(Settings(context="mip"))
    assert background(scene, "mip", window.context_window) == 0.0


@pytest.mark.parametrize("context", ["mip", "mida"])
@pytest.mark.parametrize("name", BRIGHT)
def test_of_a_volume_alone_the_lumen_stands_out(name, context):
    lumen, beside = contrast(angiography(name), context)
    assert lumen - beside >= 0.25


@pytest.mark.parametrize("name", KINDS)
def test_the_window_of_a_mip_begins_with_the_other_one_and_is_at_most_wider(name):
    volume = angiography(name).volume
    blended, mip = ends(Window.from_data(volume)), ends(Window.for_mip(volume))
    assert mip[0] == pytest.approx(blended[0])
    assert 1 - 1e-9 <= (mip[1] - mip[0]) / (blended[1] - blended[0]) <= 1.4 + 1e-9
    shown = Renderer(volume).windowed(Settings(context="mip")).context_window
    assert shown == Window.for_mip(volume)


@needs_shared_data
def test_stents_bone_and_lumen_are_not_the_same_white_in_a_mip(shared_data):
    volume = read_volume(shared_data / REAL["dissection"][0])
    camera = Camera.anterior(volume, (120, 160))
    picture = Renderer(volume).render(camera, Settings(context="mip")).image[..., 0]
    assert np.mean(picture == 255) < 0.1
    white = Settings(context="mip", context_window=Window.from_data(volume))
    assert np.mean(Renderer(volume).render(camera, white).image[..., 0] == 255) > 0.15


@pytest.mark.parametrize("name", DARK)
def test_a_dark_lumen_is_darker_than_its_tissue(name):
    scene = angiography(name)
    found = shares(scene, Window.from_data(scene.volume, scene.tree))
    window = Window.from_data(scene.volume, scene.tree)
    assert found["centerline"] <= 0.42
    # Or black, if nothing is darker.
    assert found["centerline"] >= 0.15 or ends(window)[0] == pytest.approx(np.min(scene.array))
    assert found["tissue"] > 0.60
    alone = Window.from_data(scene.volume)
    assert Renderer(scene.volume).render(Camera.left(scene.volume, (20, 20))).image[..., :3].any()
    assert alone.width > 0.05 * np.ptp(np.percentile(scene.array, [1, 99]))


def beside(points, radius, distance):
    """Return six positions at this distance beyond the wall of each point (mm)."""
    sides = np.concatenate([np.eye(3), -np.eye(3)])
    return (points[:, None] + (radius[:, None, None] + distance) * sides).reshape(-1, 3)


def lumen_and_tissue(volume, vessels):
    """Return the values along the centerlines, and all values 3 to 10 mm beyond the walls."""
    points = np.concatenate([vessel.points for vessel in vessels])
    radius = np.concatenate([vessel.radius for vessel in vessels])
    around = np.concatenate([volume.sample(beside(points, radius, mm)) for mm in (3, 5, 7, 10)])
    lumen = volume.sample(points)
    return lumen[np.isfinite(lumen)], around[np.isfinite(around)]


@pytest.mark.parametrize(
    "name", ["straight_tube", "stenosis", "calcified_wall", "aorta", "runoff", "cervical"]
)
def test_phantoms_have_the_lumen_light_and_the_tissue_dark(name):
    scaled = name in ("aorta", "runoff", "cervical")
    made = getattr(phantom, name)(**({"scale": 0.3} if scaled else {}))
    window = Window.from_data(made.volume, made.tree)
    lumen, tissue = lumen_and_tissue(made.volume, made.tree)
    assert 0.60 - 1e-6 <= share(window, lumen) <= 0.72 + 1e-6
    assert share(window, tissue) < 0.40


@needs_shared_data
@pytest.mark.parametrize("name", REAL)
def test_real_angiographies_have_the_lumen_light_and_the_tissue_dark(name, shared_data):
    volume, vessels = (shared_data / path for path in REAL[name])
    volume, vessels = read_volume(volume), read_centerlines(vessels)
    window = Window.from_data(volume, vessels)
    lumen, tissue = lumen_and_tissue(volume, vessels)
    assert 0.60 - 1e-6 <= share(window, lumen) <= 0.72 + 1e-6
    assert ends(window)[0] >= volume.array.min()
    if volume.array.min() < -500:
        assert 0.02 < share(window, [-100.0]) < 0.2
    assert share(window, tissue) < 0.40


def test_units_and_axes_do_not_change_what_a_window_shows():
    scene = angiography("CTA, HU")
    volume, expected = scene.volume, np.array(ends(Window.from_data(scene.volume)))
    along = np.array(ends(Window.from_data(volume, tree())))
    scaled = Volume(volume.array.astype(np.float32) * 0.25 + 4096)
    np.testing.assert_allclose(ends(Window.from_data(scaled)), expected * 0.25 + 4096, atol=1e-3)
    np.testing.assert_allclose(ends(Window.from_data(scaled, tree())), along * 0.25 + 4096, atol=1e-2)
    assert Window.from_data(Volume(np.asfortranarray(volume.array))) == Window.from_data(volume)


def test_fixed_windows_are_those_that_are_said():
    assert Window.named("cta") == Window(level=300, width=900)
    assert Window.named("bone") == Window(level=480, width=2500)
    assert Window.named("lung") == Window(level=-600, width=1500)
    settings = Settings(window="cta", context_window="bone")
    assert settings == Settings(window=Window.named("cta"), context_window=Window.named("bone"))


def test_windows_from_the_data_by_name():
    scene = angiography("contrast MRA")
    volume = scene.volume
    assert ends(Window.named("full", volume)) == pytest.approx((volume.array.min(), volume.array.max()))
    low, high = ends(Window.named("mra", volume))
    assert low == pytest.approx(np.percentile(volume.array, 1), rel=1e-6)
    assert high == pytest.approx(np.percentile(volume.array, 99.9), rel=1e-6)
    assert Window.named("auto", volume) == Window.from_data(volume)
    assert Window.named("auto", volume, scene.tree) == Window.from_data(volume, scene.tree)


def test_the_names_of_settings_are_known_once_there_is_a_volume():
    scene = angiography("contrast MRA")
    full, mra = (Window.named(name, scene.volume) for name in ("full", "mra"))
    renderer = Renderer(scene.volume, scene.tree)
    given = Settings(window="full", context_window="mra")
    assert renderer.windowed(given) == Settings(window=full, context_window=mra)
    assert Settings(window="auto", context_window="auto") == Settings()
    camera = Camera.anterior(scene.tree, (40, 30))
    np.testing.assert_array_equal(
        renderer.render(camera, given).image, renderer.render(camera, renderer.windowed(given)).image
    )
    assert np.isfinite(Renderer(None, scene.tree).cut_surface(camera, given).depth).any()


def test_other_names_are_refused_with_those_that_are_known():
    known = ".*".join(f"'{name}'" for name in WINDOW_NAMES)
    for refused in (
        lambda: Settings(window="abdomen"),
        lambda: Settings(context_window="CTA"),
        lambda: Window.named("abdomen"),
    ):
        with pytest.raises(SettingsError, match=rf"window: found '(abdomen|CTA)'; expected .*{known}"):
            refused()
    with pytest.raises(SettingsError, match=r"window: found \(300, 900\); expected a Window"):
        Settings(window=(300, 900))
    for name in ("mra", "full", "auto"):
        with pytest.raises(VolumeError, match="NoneType"):
            Window.named(name)


@pytest.fixture
def files(tmp_path):
    """A volume and centerlines as files."""
    import SimpleITK

    scene = angiography("CTA, HU")
    volume, lines = tmp_path / "ct.nii.gz", tmp_path / "lines.vtp"
    SimpleITK.WriteImage(SimpleITK.GetImageFromArray(scene.volume.array), str(volume))
    write_centerlines(scene.tree, lines)
    return volume, lines


def run(*arguments):
    return CliRunner().invoke(main, [str(argument) for argument in arguments])


def test_the_command_line_takes_names_and_numbers(files, tmp_path):
    volume, lines = files
    picture = tmp_path / "picture.png"
    common = ("render", volume, lines, "-o", picture, "--size", "40x40")
    for option, said in (
        ("cta", "window 900/300"),
        ("600/200", "window 600/200"),
        ("lung", "window 1500/-600"),
    ):
        result = run(*common, "--window", option)
        assert result.exit_code == 0, result.output
        assert said in result.output
    array = angiography("CTA, HU").array.astype(float)
    width, level = np.ptp(array), array.min() + np.ptp(array) / 2
    result = run("render", volume, "-o", picture, "--size", "40x40", "--context-window", "full")
    assert f"context window {width:.4g}/{level:.4g}" in result.output
    result = run(*common, "--window", "abdomen")
    assert result.exit_code == 2
    assert "not of the form WIDTH/LEVEL, such as 900/300, nor one of" in " ".join(result.output.split())
    turned = tmp_path / "turn.webp"
    result = run(
        "turntable", volume, lines, "-o", turned, "--frames", 2, "--size", "20x20", "--window", "mra"
    )
    assert result.exit_code == 0, result.output
    scene = angiography("CTA, HU")
    window = Window.named("mra", scene.volume, scene.tree)
    assert f"window {window.width:.4g}/{window.level:.4g}" in result.output
    worst = tmp_path / "worst"
    options = ("--views", 1, "--size", "40x40", "--pictures", worst, "--window", "bone", "--methods", "csr")
    result = run("evaluate", volume, lines, *options)
    assert result.exit_code == 0, result.output
    assert read_recipe(worst / "csr.png").settings.window == Window.named("bone")


def test_a_window_that_shows_one_grey_is_warned_of(files, tmp_path):
    import SimpleITK

    small = tmp_path / "small.nii.gz"
    scene = angiography("mask, 0 and 1")
    SimpleITK.WriteImage(SimpleITK.GetImageFromArray(scene.volume.array), str(small))
    picture = tmp_path / "picture.png"
    for volume, option, warned in (
        (small, "lung", True),
        (small, "cta", True),
        (small, "full", False),
        (files[0], "cta", False),
        (files[0], "200/9000", True),
    ):
        result = run("render", volume, files[1], "-o", picture, "--size", "40x40", "--window", option)
        assert result.exit_code == 0, result.output
        assert ("in one grey: its values reach from" in result.output) == warned, option


def test_the_names_on_the_command_line_are_those_of_the_package():
    assert CLI_NAMES == WINDOW_NAMES


def test_vessels_at_the_border_of_a_volume_have_a_window():
    array = np.random.default_rng(1).normal(100, 5, (12, 12, 30))
    array[5:7, 5:7] = 400
    line = Vessel(np.array([[0.0, 5.5, 5.5], [29.0, 5.5, 5.5]]), 1.0)
    window = Window.from_data(Volume(array), VesselTree([line]))
    assert 0.5 <= share(window, [400.0]) <= 0.85


def test_python_command_line_and_page_have_the_same_windows_by_name():
    names = tuple(name for name, _, _ in _lumencut.WINDOW_PRESETS)
    assert names == WINDOW_NAMES == CLI_NAMES
    for name, _, fixed in _lumencut.WINDOW_PRESETS:
        assert fixed is None or (Window.named(name).level, Window.named(name).width) == fixed
    # The page shows the list of keys from the facade; its bindings with their help are in this file.
    bindings = (ROOT / "web/src/input/bindings.ts").read_text()
    keys = re.findall(r"key\('(\d)', 'preset (\d)', 'window (?:for|from|suggested by) ([^']+)'\)", bindings)
    said = {"auto": "the data", "full": "the smallest to the largest value", "stent": "stents"}
    for number, (name, words, _) in enumerate(_lumencut.WINDOW_PRESETS):
        key, preset, told = keys[number]
        assert (int(key), int(preset)) == (number + 1, number)
        assert told.lower() == said.get(name, words.lower())
    assert len(keys) == len(names)


@pytest.mark.parametrize("has_tree", [False, True])
def test_contexts_have_the_windows_that_the_facade_names(has_tree):
    scene = angiography("CTA, HU")
    renderer = Renderer(scene.volume, scene.tree if has_tree else None)
    named = {
        "auto": Window.from_data(scene.volume, renderer.tree),
        "mip": Window.for_mip(scene.volume),
        "whole": Window.whole(scene.volume),
    }
    expected = ["auto", "auto", "auto" if has_tree else "mip", "whole", "whole"]
    for context, name in zip(("mida", "dvr", "mip", "minip", "average"), expected, strict=True):
        assert _lumencut.context_window(context, has_tree) == name
        assert renderer.windowed(Settings(context=context)).context_window == named[name]
