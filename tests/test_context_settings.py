"""Settings of context and slab: which values are valid, and the window computed from only a volume."""

from __future__ import annotations

import pickle
from dataclasses import fields, replace

import numpy as np
import pytest

from lumencut import (
    Settings,
    SettingsError,
    Slab,
    TransferFunction,
    VesselTreeError,
    Volume,
    VolumeError,
    Window,
    _lumencut,
    phantom,
    render,
)
from lumencut.scene.camera import Camera

POINTS = [(-50, (0, 0, 0), 0), (100.5, (255, 128, 0), 0.25), (100.5, (255, 255, 255), 1)]
NUMBERS = [None, "1", [1], 1j, np.nan, np.inf, -np.inf]


def test_the_defaults():
    names = [field.name for field in fields(Settings)]
    assert names[-15:] == [
        "slab", "focus", "focus_vessels", "others_strength", "context", "context_gamma",
        "context_window", "context_transfer", "context_step", "context_shading",
        "context_from", "context_strength", "context_halo", "context_body", "context_preview",
    ]  # fmt: skip
    values = [getattr(Settings(), name) for name in names[-15:]]
    assert values == [None, None, (), 0.5, "mida", 0.0, None, None, None, False, None, 1.0, 0.0, False, False]
    assert Slab(2).mode == "max"


def test_what_settings_take_is_kept():
    settings = Settings(
        slab=Slab(np.float32(4), "min"),
        context="mida",
        context_gamma=np.int8(-1),
        context_window=Window(1, 2),
        context_transfer=TransferFunction(POINTS),
        context_step=np.float64(0.5),
        context_shading=np.True_,
        context_preview=True,
    )
    assert (settings.context_gamma, settings.context_step, settings.slab.thickness) == (-1.0, 0.5, 4.0)
    assert (settings.context_shading, type(settings.context_shading)) == (True, bool)
    again = pickle.loads(pickle.dumps(settings))
    assert again == settings
    assert hash(again) == hash(settings)
    assert replace(again, context=None, context_gamma=0).context is None


def test_transfer_functions_are_their_points():
    function = TransferFunction(POINTS)
    assert function.points == tuple(POINTS)
    assert function == TransferFunction(tuple(map(list, POINTS)))
    assert function == TransferFunction([(np.float32(p[0]), np.array(p[1]), p[2]) for p in POINTS])
    assert function != TransferFunction(POINTS[:2])
    assert len({function, TransferFunction(POINTS)}) == 1
    for count in (1, 64):
        assert len(TransferFunction(POINTS[:1] * count).points) == count


@pytest.mark.parametrize(
    ("points", "text"),
    [
        ([], "context_transfer: found 0 control points; expected 1 to 64"),
        (POINTS[:1] * 65, "context_transfer: found 65 control points; expected 1 to 64"),
        (POINTS[::-1], r"intensity of control point 3 of .*: found -50 after 100\.5; expected rising"),
        (
            [(1, (0, 0, 0), -0.1)],
            r"opacity of control point 1 of .*: found -0\.1; expected between 0 and 1 per",
        ),
        (
            [(1, (0, 0, 0), 1.1)],
            r"opacity of control point 1 of .*: found 1\.1; expected between 0 and 1 per mm",
        ),
        (
            [(1, (0, 0, 256), 0)],
            r"colour of control point 1 .*: found \(0, 0, 256\); expected 3 whole numbers",
        ),
        ([(1, (0, 0, 0.5), 0)], "colour of control point 1 .*; expected 3 whole numbers from 0 to 255"),
        ([(1, "red", 0)], "colour of control point 1 .*found 'red'; expected"),
        (
            [(1, (0, 0, 0))],
            r"control point 1 .*: found \(1, \(0, 0, 0\)\); expected one of the control points",
        ),
        (["abc"], "control point 1 of the transfer function: found 'abc'; expected"),
        ([5], "control point 1 of the transfer function: found 5; expected"),
        ("grey", "points of the transfer function: found str; expected a sequence of control points"),
        (None, "points of the transfer function: found NoneType; expected"),
        (iter(POINTS), "points of the transfer function: found list_iterator; expected"),
    ],
)
def test_transfer_functions_that_are_none(points, text):
    with pytest.raises(SettingsError, match=text):
        TransferFunction(points)


@pytest.mark.parametrize("value", NUMBERS, ids=repr)
@pytest.mark.parametrize("place", [0, 2])
def test_control_points_without_numbers(value, place):
    point = [1.0, (0, 0, 0), 0.5]
    point[place] = value
    with pytest.raises(SettingsError, match=r"(intensity|opacity) of control point 1 .*found .*; expected"):
        TransferFunction([tuple(point)])


@pytest.mark.parametrize("value", [*NUMBERS, -1e-9, 1001], ids=repr)
def test_slabs_of_no_thickness(value):
    with pytest.raises(SettingsError, match=r"slab thickness: found .*; expected"):
        Slab(value)


@pytest.mark.parametrize("mode", [None, "", "MAX", 3, "\ud800", ["max"]], ids=ascii)
def test_slabs_of_an_unknown_mode(mode):
    with pytest.raises(SettingsError, match=r"slab mode: found .*; expected one of 'max', 'mean', 'min'"):
        Slab(1, mode)


@pytest.mark.parametrize(
    ("given", "text"),
    [
        (
            {"context": "xray"},
            "context: found 'xray'; expected one of 'mida', 'dvr', 'mip', 'minip', 'average' or",
        ),
        ({"context": True}, "context: found True; expected one of 'mida'"),
        ({"context_gamma": 1.01}, r"context_gamma: found 1\.01; expected between -1 and 1"),
        ({"context_gamma": "a"}, "context_gamma: found 'a'; expected"),
        (
            {"context_gamma": 0.5, "context": "dvr"},
            r"context_gamma: found 0\.5 with the context 'dvr'; expected 0,",
        ),
        (
            {"context_gamma": -1, "context": None},
            "found -1 with the context None; expected 0, or the context 'mida'",
        ),
        ({"context_window": (1, 2)}, r"context_window: found \(1, 2\); expected a Window, one of .* or None"),
        ({"context_step": 0}, r"context_step: found 0; expected between 0\.001 and 1000 mm"),
        ({"context_step": np.nan}, "context_step: found NaN; expected"),
        ({"context_step": "1"}, "context_step: found '1'; expected"),
        (
            {"context_step": 0.5, "context": "mip"},
            r"context_step: found 0\.5 mm with the context 'mip'; expected no step: this context has exact",
        ),
        (
            {"context_transfer": "red"},
            "context_transfer: found 'red'; expected one of 'grey', 'angio', 'bone', 'soft",
        ),
        ({"context_transfer": POINTS}, "context_transfer: found .*, a TransferFunction or None"),
        ({"context_shading": 1}, "context_shading: found 1; expected True or False"),
        ({"context_preview": None}, "context_preview: found None; expected True or False"),
        ({"slab": 4}, "slab: found 4; expected a Slab or None"),
    ],
    ids=str,
)
def test_settings_out_of_range(given, text):
    with pytest.raises(SettingsError, match=text):
        Settings(**given)


def test_a_window_of_no_width_is_no_window():
    with pytest.raises(SettingsError, match="window width: found 0; expected between"):
        Settings(context_window=Window(3, 0))


def test_every_preset_and_every_context_is_taken_and_makes_another_picture():
    made = phantom.aorta(scale=0.25)
    # Includes air, so that smallest and mean values are not all black.
    camera, window = Camera.anterior(made.volume, (60, 60)), Window(0.0, 2200.0)

    def picture(**given):
        return render(made.volume, None, camera, Settings(context_window=window, **given)).image.tobytes()

    presets = [picture(context_transfer=name) for name in _lumencut.SETTINGS["context_transfer"].choices]
    assert len(set(presets)) == len(presets) == 4
    contexts = [picture(context=name) for name in _lumencut.SETTINGS["context"].choices]
    assert len(set(contexts)) == len(contexts) == 5
    assert picture(context="dvr") == picture(context_gamma=-1)
    # Even with gamma 1 the transfer function is that of MIDA; MIP has its own.
    assert picture(context="mip", context_transfer="angio") == picture(context_gamma=1)
    assert picture() == picture(context_transfer="angio")
    assert picture(context="mip") == picture(context="mip", context_transfer="grey")
    for name in ("minip", "average"):
        assert picture(context=name) == picture(context=name, context_transfer="bone")


@pytest.mark.parametrize("name", ["aorta", "runoff", "cervical"])
def test_the_window_of_a_volume_alone_shows_the_lumen_and_not_the_tissue(name):
    made = getattr(phantom, name)(scale=0.3)
    alone, along = Window.from_data(made.volume), Window.from_data(made.volume, made.tree)
    lumen = np.nanmedian(made.volume.sample(np.concatenate([vessel.points for vessel in made.tree])))
    assert 0.6 - 1e-6 <= (lumen - along.level) / along.width + 0.5 <= 0.72 + 1e-6
    # Values of lumen and tissue in the phantoms.
    assert 0.4 < (350 - alone.level) / alone.width + 0.5 < 0.8
    assert (60 - alone.level) / alone.width + 0.5 < 0.28


def test_windows_of_what_is_no_volume_or_beyond_all_windows():
    with pytest.raises(VolumeError, match=r"found .*NoneType"):
        Window.from_data(None)
    with pytest.raises(VesselTreeError, match="tree: found list; expected a VesselTree or None"):
        Window.from_data(Volume(np.zeros((2, 2, 2))), [])
    with pytest.raises(
        VolumeError, match=r"found values from 1e\+30 to 1e\+30; .* give window= and context_"
    ):
        Window.from_data(Volume(np.full((4, 4, 4), 1e30)))
