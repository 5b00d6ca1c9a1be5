"""Everything generated from the table of settings: the class, the page, and checks, made only once."""

from __future__ import annotations

import copy
import importlib.util
import pickle
from dataclasses import asdict, fields, replace
from pathlib import Path

import numpy as np
import pytest

from lumencut import Renderer, Settings, Slab, TransferFunction, Vessel, VesselTree, Volume, Window, _lumencut
from lumencut.scene.camera import Camera
from scene_files import bent_line

ROOT = Path(__file__).resolve().parents[1]


@pytest.fixture
def changed():
    return Settings(slab=Slab(2, "min"), window=Window(1, 2), context_transfer="bone", levels=3)


def written_files():
    spec = importlib.util.spec_from_file_location("settings_script", ROOT / "scripts/settings.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.files()


@pytest.mark.parametrize("path", ["python/lumencut/scene/settings.py", "docs/settings.md", "docs/python.md"])
def test_what_repeats_the_table_is_what_the_script_writes(path):
    assert (ROOT / path).read_text("utf-8") == written_files()[ROOT / path], "run: make generate"


def test_the_class_has_the_settings_of_the_table_and_their_defaults():
    found = {field.name: field.default for field in fields(Settings)}
    assert found == {name: setting.default for name, setting in _lumencut.SETTINGS.items()}
    assert list(found) == list(_lumencut.SETTINGS)
    for name, setting in _lumencut.SETTINGS.items():
        assert f"\n    {name} : " in Settings.__doc__
        assert type(getattr(Settings(), name)) is type(setting.default)


@pytest.mark.parametrize(
    "again",
    [
        lambda settings: pickle.loads(pickle.dumps(settings)),
        lambda settings: pickle.loads(pickle.dumps(settings, 0)),
        copy.copy,
        copy.deepcopy,
        replace,
        lambda settings: Settings(**vars(settings)),
    ],
)
def test_settings_made_again_are_the_same_and_render(again, changed):
    made = again(changed)
    assert made == changed
    assert hash(made) == hash(changed)
    assert repr(made) == repr(changed)
    camera = Camera((0, 0, 0), (0, 1, 0), (0, 0, 1), (5, 4))
    tree = VesselTree([Vessel(bent_line(), 3.0)])
    depths = [Renderer(None, tree).cut_surface(camera, settings).depth for settings in (made, changed)]
    assert (depths[0] == depths[1]).all()


def test_what_the_core_keeps_of_settings_is_no_field(changed):
    names = list(_lumencut.SETTINGS)
    assert list(vars(changed)) == list(asdict(changed)) == names
    assert "_checked" not in repr(changed)
    with pytest.raises(AttributeError):
        changed._checked = None


def test_settings_that_are_pickled_out_of_range_are_refused(changed):
    out_of_range = {**vars(changed), "level_distance": -1.0}
    with pytest.raises(ValueError, match="level_distance: found -1; expected between"):
        Settings.__new__(Settings).__setstate__(out_of_range)


def test_settings_are_checked_when_they_are_made_and_not_when_they_are_used(monkeypatch):
    counted = []
    original = _lumencut.Settings

    def counting(attributes):
        counted.append(attributes)
        return original(attributes)

    monkeypatch.setattr(_lumencut, "Settings", counting)
    window = Window(300, 900)
    TransferFunction([(1, (0, 0, 0), 0.5)])
    assert counted == []
    settings = Settings(window=window, context_window=window)
    assert counted == [settings]
    renderer = Renderer(Volume(np.zeros((32, 20, 24), np.int16)), VesselTree([Vessel(bent_line(), 3.0)]))
    camera = Camera((5, 5, 5), (0, 1, 0), (0, 0, 1), (6, 5))
    renderer.cut_surface(camera, settings)
    renderer.render(camera, settings)
    assert counted == [settings]
    # If windows are None, settings with windows from the data are new objects.
    renderer.render(camera, replace(settings, window=None))
    assert [made.window is None for made in counted] == [False, True, False]
