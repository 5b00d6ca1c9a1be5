"""Rims from Python and the command line: values, legends, files and errors."""

from __future__ import annotations

import pickle
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

import lumencut
from lumencut import Camera, MeasuringError, Renderer, Settings, Vessel, VesselTree, Volume, _lumencut
from lumencut import phantom as phantoms
from lumencut.cli import main
from lumencut.pictures.recipe import read_recipe
from scene_files import write_volume_of

RIM = Settings(rim="diameter")


@pytest.fixture(scope="module")
def stenosis() -> phantoms.Phantom:
    return phantoms.stenosis(50.0)


@pytest.fixture(scope="module")
def profile(stenosis: phantoms.Phantom) -> lumencut.Profile:
    return lumencut.measure(stenosis.volume, stenosis.tree[0], tree=stenosis.tree)


def cone() -> VesselTree:
    """A straight vessel along z whose radius grows from 1 to 5 mm over 80 mm."""
    z = np.linspace(-40, 40, 81)
    points = np.stack([np.zeros(81), np.zeros(81), z], axis=1)
    return VesselTree([Vessel(points, 1 + (z + 40) / 20)])


def grey() -> Volume:
    """A volume of one value, which is dark in the window of the tests."""
    return Volume(np.full((50, 30, 30), 50, np.int16), spacing=(2, 2, 2), origin=(-29, -29, -49))


def test_colours_of_a_cone_follow_its_diameter():
    settings = Settings(rim="diameter", context=None, window=lumencut.Window(level=500, width=1000))
    camera = Camera((0, 0, 0), (0, 1, 0), (0, 0, 1), (80, 160), 0.5)
    plain = lumencut.render(grey(), cone(), camera, replace(settings, rim=None))
    frame = lumencut.render(grey(), cone(), camera, settings)
    columns, rows = np.meshgrid(np.arange(80), np.arange(160))
    x, z = (columns - 39.5) * 0.5, (79.5 - rows) * 0.5
    radius = 3 + z / 20
    beyond = np.abs(x) - radius
    untouched = (beyond < 1.2) | (beyond > 1.2 + 0.5 + 1.6)
    assert np.array_equal(frame.image[untouched], plain.image[untouched])
    middle = np.abs(beyond - (1.2 + 0.25 + 0.8)) < 0.3
    colours = frame.image[middle & (np.abs(z) < 38)][:, :3].astype(float)
    # The scale runs from 2 mm to 10 mm: dark blue to pale green, 90 % over a grey of 5 %.
    ends = np.array([(65, 61, 123), (222, 245, 229)], float)
    table = np.array([ends[0], (55, 101, 158), (52, 143, 167), (64, 183, 173), (139, 218, 178), ends[1]])
    share = (2 * radius[middle & (np.abs(z) < 38)] - 2) / 8 * 5
    expected = np.stack([np.interp(share, np.arange(6), table[:, c]) for c in range(3)], axis=1)
    dark = plain.image[0, 0, 0]
    assert np.abs(colours - (0.9 * expected + 0.1 * dark)).max() < 3
    for name in ("depth", "vessel", "value"):
        assert np.array_equal(getattr(frame, name), getattr(plain, name))


@pytest.mark.parametrize("rim", ["narrowing", "deviation", "uncertainty"])
def test_values_other_than_diameters_come_from_profiles(stenosis, profile, rim):
    settings = Settings(rim=rim)
    with pytest.raises(MeasuringError, match="values along the vessels: found no "):
        lumencut.render(stenosis.volume, stenosis.tree, settings=settings)
    spot = profile.narrowest()
    before, _ = profile.suggested_references(spot.arc_length)
    graded = profile.stenosis(spot.arc_length, before.arc_length)
    frame = lumencut.render(stenosis.volume, stenosis.tree, settings=settings, profiles=[(profile, [graded])])
    plain = lumencut.render(stenosis.volume, stenosis.tree)
    changed = (frame.image != plain.image).any(axis=2)
    assert 50 < changed.sum() < 0.2 * changed.size
    legend = frame._source.legend
    assert legend.unit == ("%" if rim == "narrowing" else "mm")
    if rim == "narrowing":
        assert legend.low == 0
        assert legend.high == 10 * np.ceil(graded.percent / 10)
    if rim == "deviation":
        assert legend.low == -legend.high


def test_labels_explain_the_colours_and_frames_can_be_pickled(stenosis):
    renderer = Renderer(stenosis.volume, stenosis.tree)
    frames = [renderer.render(settings=settings) for settings in (Settings(), RIM)]
    right = [(frame.annotated() != frame.image).any(axis=2)[:, -60:].sum() for frame in frames]
    assert right[1] > right[0] + 500
    assert pickle.loads(pickle.dumps(frames[1]))._source.legend == frames[1]._source.legend


def test_bad_profiles_are_refused(stenosis, profile):
    other = VesselTree([Vessel(stenosis.tree[0].points + np.array([8.0, 0, 0]), 3.0)])
    for given, tree, found in [
        ([profile], other, "follows no vessel of the tree"),
        ([profile, profile], stenosis.tree, "two profiles of vessel 0"),
        (["x"], stenosis.tree, "expected Profile"),
        (3, stenosis.tree, "expected several Profile"),
        ([(profile, ["x"])], stenosis.tree, "expected Profile"),
    ]:
        with pytest.raises(MeasuringError, match=found):
            Renderer(stenosis.volume, tree, profiles=given)


def test_a_rim_needs_radii_that_count(stenosis, profile):
    bare = VesselTree([Vessel(stenosis.tree[0].points)])
    with pytest.raises(MeasuringError, match="neither radii nor profiles"):
        lumencut.render(stenosis.volume, bare, settings=RIM)
    with pytest.raises(lumencut.VesselTreeError, match="vessels without radii"):
        lumencut.render(stenosis.volume, bare, settings=RIM, profiles=[profile])
    with pytest.raises(lumencut.SettingsError, match="rim without preserve_lumen"):
        Settings(rim="diameter", preserve_lumen=False)
    with pytest.raises(lumencut.SettingsError, match="a rim for"):
        lumencut.mpcpr(stenosis.volume, stenosis.tree, settings=RIM)


def test_the_command_renders_radii_or_measures(stenosis, tmp_path: Path):
    volume, lines = tmp_path / "ct.nii.gz", tmp_path / "lines.csv"
    write_volume_of(stenosis.volume, volume)
    lumencut.write_centerlines(stenosis.tree, lines)
    arguments = ["render", str(volume), str(lines), "--size", "256x256", "-o"]
    for options in (["--rim", "diameter"], ["--rim", "diameter", "--measured"], ["--rim", "uncertainty"]):
        out = tmp_path / f"{len(options)}{options[1]}.png"
        result = CliRunner().invoke(main, [*arguments, str(out), *options])
        assert result.exit_code == 0, result.output
        assert read_recipe(out).settings.rim == options[1]
    for options, found in [
        (["--rim", "narrowing"], "no graded stenosis"),
        (["--measured"], "--measured does nothing without --rim diameter"),
    ]:
        result = CliRunner().invoke(main, [*arguments, str(tmp_path / "no.png"), *options])
        assert result.exit_code != 0
        assert found in result.output
    assert not (tmp_path / "no.png").exists()


#: Colours as seen without one kind of cone, in linear RGB (Machado, Oliveira and Fernandes 2009).
_EYES = {
    "all cones": np.eye(3),
    "no red": ((0.152, 1.053, -0.205), (0.115, 0.786, 0.099), (-0.004, -0.048, 1.052)),
    "no green": ((0.367, 0.861, -0.228), (0.280, 0.673, 0.047), (-0.012, 0.043, 0.969)),
    "no blue": ((1.256, -0.077, -0.179), (-0.078, 0.931, 0.148), (0.005, 0.691, 0.304)),
}


def lab(colours: object, eye: str) -> np.ndarray:
    """Return colours (n, 3) of 8 bits as CIELAB, in which equal distances look about equal."""
    srgb = np.asarray(colours, float) / 255
    linear = np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)
    seen = np.clip(linear @ np.array(_EYES[eye]).T, 0, 1)
    to_xyz = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])
    x, y, z = np.cbrt(seen @ to_xyz.T / (0.9505, 1, 1.089)).T
    return np.stack([116 * y - 16, 500 * (x - y), 200 * (y - z)], axis=1)


@pytest.mark.parametrize("eye", _EYES)
def test_colours_can_be_told_apart_by_colour_blind_readers_and_from_lines(eye):
    steps = np.linspace(0, 1, 6, dtype=np.float32)[:, None]
    for colours in ("sea", "blue-red"):
        seen = lab(_lumencut.coloured(steps, (0, 1), colours)[:, 0, :3], eye)
        apart = np.linalg.norm(seen[:, None] - seen, axis=2)[np.triu_indices(6, 1)]
        assert apart.min() > 10
        assert np.linalg.norm(seen - lab([Settings().silhouette_color], eye), axis=1).min() > 9
    lightness = lab(_lumencut.coloured(steps, (0, 1), "sea")[:, 0, :3], eye)[:, 0]
    assert np.diff(lightness).min() > 10


def test_dicom_states_what_the_colours_mean(stenosis, tmp_path: Path):
    frame = lumencut.render(stenosis.volume, stenosis.tree, settings=RIM)
    made = frame._as_object(annotate=True, vessel_names=False)
    assert "Colours: diameter from " in made.words
    assert (made.image != frame.image).any()
