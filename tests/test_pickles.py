"""Pickles of public values: the names in them, and that values are equal after unpickling."""

from __future__ import annotations

import copy
import json
import pickle
import pickletools
import subprocess
import sys
import types

import numpy as np
import pytest

import lumencut
from lumencut import MeasuringError, Settings, Vessel, _lumencut, phantom
from lumencut.measuring.profile import Throat


@pytest.fixture(scope="module")
def tube():
    return phantom.stenosis()


@pytest.fixture(scope="module")
def profile(tube):
    return lumencut.measure(tube.volume, tube.tree[0], step=2.0)


@pytest.fixture(scope="module")
def values(tube, profile):
    camera = lumencut.Camera.anterior(tube.tree, (24, 16))
    return {
        "Camera": camera,
        "CArm": profile.c_arm(10, 40),
        "CenterlineComparison": lumencut.compare_centerlines(tube.tree, tube.tree),
        "CrossSection": lumencut.cross_section(tube.volume, tube.tree[0], at=30),
        "Flag": lumencut.Flag.METAL | lumencut.Flag.CALCIUM,
        "Focus": lumencut.Focus(3, 4),
        "Frame": lumencut.render(tube.volume, tube.tree, camera=camera),
        "Mend": lumencut.Mend("fill_gaps"),
        "Opacity": lumencut.Opacity(0, 1),
        "Profile": profile,
        "ScanDetails": lumencut.ScanDetails("4", "CTA"),
        "Settings": Settings.focused(),
        "Slab": lumencut.Slab(3),
        "Spot": profile.narrowest(),
        "Stenosis": profile.stenosis(at=31.0, reference=52.0),
        "Stretch": profile.stretch(10, 40),
        "Throat": Throat(20.0, 0.7),
        "TransferFunction": lumencut.TransferFunction([(0, (1, 2, 3), 0.5)]),
        "Vessel": tube.tree[0],
        "VesselTree": tube.tree,
        "Volume": tube.volume,
        "Window": lumencut.Window(3, 4),
    }


def test_pickles_name_no_module_of_the_package(values):
    for name, value in values.items():
        # The oldest binary protocol writes every name in full.
        operations = pickletools.genops(pickle.dumps(value, 2))
        found = {argument for operation, argument, _ in operations if operation.name == "GLOBAL"}
        assert {one for one in found if one.startswith("lumencut")} == {"lumencut _restored"}, name


def test_a_pickle_survives_a_move_of_its_module(monkeypatch, values):
    for name in ("Profile", "Window", "VesselTree"):
        pickled = pickle.dumps(values[name])
        moved = types.ModuleType(f"lumencut.moved_{name}")
        setattr(moved, name, getattr(lumencut, name))
        monkeypatch.setitem(sys.modules, moved.__name__, moved)
        monkeypatch.setitem(sys.modules, f"lumencut.{lumencut._MODULE[name]}", None)
        monkeypatch.setitem(lumencut._MODULE, name, f"moved_{name}")
        assert type(pickle.loads(pickled)).__name__ == name


def all_of(profile):
    """Everything that a profile holds, as text."""
    return _lumencut.profile_record(profile._core), profile.scan, profile.to_json()


@pytest.mark.parametrize("protocol", range(pickle.HIGHEST_PROTOCOL + 1))
def test_a_profile_is_the_same_to_the_bit(profile, protocol):
    for again in (pickle.loads(pickle.dumps(profile, protocol)), copy.copy(profile), copy.deepcopy(profile)):
        assert all_of(again) == all_of(profile)
        assert not again.area.flags.writeable
        graded, before = (one.stenosis(at=31.0, reference=52.0) for one in (again, profile))
        assert str(graded) == str(before)
        assert again._vessel == profile._vessel


def test_a_stenosis_is_the_same(values):
    graded = values["Stenosis"]
    again = pickle.loads(pickle.dumps(graded))
    assert str(again) == str(graded)
    names = ("percent", "percent_uncertainty", "at", "diameter", "uncertainty", "reference", "references")
    for name in names:
        assert getattr(again, name) == getattr(graded, name)
    assert (again.method, again.doubts) == (graded.method, graded.doubts)


def test_another_process_reads_a_profile(tmp_path, profile):
    (tmp_path / "profile.pickle").write_bytes(pickle.dumps(profile))
    code = "import pickle, sys; print(pickle.load(open(sys.argv[1], 'rb')).to_json(), end='')"
    command = [sys.executable, "-c", code, str(tmp_path / "profile.pickle")]
    assert subprocess.run(command, capture_output=True, text=True, check=True).stdout == profile.to_json()


def test_a_profile_of_another_version_is_refused(profile):
    state = profile.__getstate__()
    state["version"] = 3
    with pytest.raises(MeasuringError, match="stored profile: found version 3; expected version 1 or 2"):
        lumencut._restored("Profile").__setstate__(state)
    record = json.loads(profile.__getstate__()["record"])
    del record["columns"]["arc_length"]
    state = profile.__getstate__() | {"record": json.dumps(record)}
    with pytest.raises(MeasuringError, match="no column arc_length"):
        lumencut._restored("Profile").__setstate__(state)


def test_a_pickle_of_columns_is_read(profile):
    record = json.loads(profile.__getstate__()["record"])
    record["columns"]["uncertainty"][:2] = ["infinity", "-infinity"]
    numbers = {"infinity": np.inf, "-infinity": -np.inf}
    columns = [
        (name, np.array([numbers.get(one, one) for one in values], np.float64))
        for name, values in record["columns"].items()
    ]
    stored = (columns, np.array(record["flags"], np.uint32), record["fwhm_source"], record["wall_source"])
    state = {"version": 1, "stored": stored, "scan": tuple(profile.scan.__dict__.values())}
    again = lumencut._restored("Profile")
    again.__setstate__(state | {"vessel": profile._vessel, "origin": None})
    assert json.loads(_lumencut.profile_record(again._core)) == record


class Named(Vessel):
    """A subclass of Vessel defined in another program."""


def test_a_subclass_is_pickled_as_itself():
    again = pickle.loads(pickle.dumps(Named([[0, 0, 0], [1, 1, 1]], 2.0, "LAD")))
    assert type(again) is Named
    np.testing.assert_array_equal(again.points, [[0, 0, 0], [1, 1, 1]])
