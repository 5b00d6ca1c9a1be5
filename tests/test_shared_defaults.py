"""Defaults and names of methods are defined only once, below Python."""

import importlib
import inspect
import json
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from lumencut import (
    Vessel,
    VesselTree,
    Volume,
    _lumencut,
    cfa,
    cpr,
    find_vessels,
    lumen_map,
    spiral,
    straightened_volume,
    trace_from,
    untangled,
)
from lumencut.cli import main
from lumencut.cohort.recipe import Measure, Pictures
from lumencut.cohort.study import _pictures
from lumencut.measuring.measured_vessel import GROUPS
from lumencut.measuring.stenosis import METHODS
from lumencut.pictures.renderer import Renderer
from lumencut.reformations.planar_reformation import CprRequest
from scene_files import write_lines, write_volume_of

#: Modules with functions that the package does not export.
HOMES = {"uncurling": "lumencut.reformations.uncurling"}

#: The command of each function; its options have the names of the parameters.
COMMANDS = {
    "cfa": "cfa",
    "cr": "compare",
    "measure": "measure",
    "trace": "trace",
    "trace_mask": "trace",
    "turntable": "turntable",
    "uncurling": "uncurl",
    "untangled": "untangled",
    "cpr": "cpr",
    "lumen_map": "map",
    "spiral": "spiral",
}


def parameters():
    for name, also, _, _, default, _ in _lumencut.QUANTITIES:
        function, _, parameter = name.rpartition(".")
        for one in (function, *also):
            yield pytest.param(one, parameter, default, id=f"{one}.{parameter}")


def function_of(name):
    found = importlib.import_module(HOMES.get(name.split(".")[0], "lumencut"))
    for part in name.split("."):
        found = getattr(found, part)
    return found


@pytest.mark.parametrize(("function", "parameter", "default"), list(parameters()))
def test_defaults_of_functions_and_commands_are_those_of_the_table(function, parameter, default):
    name, _, part = parameter.partition("[")
    stated = inspect.signature(function_of(function)).parameters[name].default
    if part:
        stated = stated[int(part[0])]
    # `cpr` has no constant default: its other modes exceed the width of the vessel by the same margin.
    assert stated == default or (function, parameter, stated) == ("cpr", "width", None)
    options = main.commands[COMMANDS[function]].params if function in COMMANDS else []
    chosen = [option.default for option in options if option.name == parameter]
    # By default the command repeats columns at the edges, dimmed; the function repeats none.
    expected = 15 if (function, parameter) == ("lumen_map", "overlap") else default
    assert all(number == expected for number in chosen if isinstance(number, (int, float)))


def test_the_step_of_cohorts_is_that_of_the_table():
    assert Measure().step == _lumencut.DEFAULTS["measure.step"]


def test_the_default_width_is_that_of_the_table():
    line = Vessel([[10, 10, 2], [10, 10, 18]])
    volume = Volume(np.zeros((101, 101, 101), np.float32), (1.0,) * 3)
    own = cpr(volume, line, "straightened").size
    assert own == cpr(volume, line, "straightened", _lumencut.DEFAULTS["cpr.width"]).size


#: Drawn volumes and the pixel sides that Python and the page show them with.
SIDES = json.loads((Path(__file__).parent / "pixel_sides.json").read_text("utf-8"))


@pytest.fixture(params=SIDES["cases"].values(), ids=SIDES["cases"])
def case(request):
    return request.param


@pytest.fixture
def scan(case):
    """Return a small volume, a vessel through its middle, and the pixel side of its reformations."""
    spacing = case["spacing"]
    grid = np.indices(SIDES["voxels"][::-1])
    away = np.hypot(grid[1] - 10, grid[2] - 10)
    volume = Volume(np.where(away < 5, 300.0, 0.0).astype(np.float32), spacing)
    (x, y, start), (_, _, end) = SIDES["line"]
    points = np.array([[x, y, k] for k in range(start, end + 1)]) * spacing
    return volume, Vessel(points, 4.5 * spacing[0], "aorta"), case["side"]


def test_a_straightened_vessel_is_that_of_the_page(scan, case):
    volume, vessel, side = scan
    made = cpr(volume, vessel, "straightened", SIDES["width"] * spacing_of(volume))
    assert (made.pixel_spacing, made.size) == (pytest.approx(side), tuple(case["size"]))


def test_every_reformation_has_the_same_default_pixel_side(scan):
    volume, vessel, side = scan
    tree = VesselTree([vessel])
    width = 4 * spacing_of(volume)
    made = {
        "straightened": cpr(volume, vessel, "straightened", width),
        "stretched": cpr(volume, vessel, "stretched", width),
        "projected": cpr(volume, vessel, "projected", width),
        "cfa": cfa(volume, vessel, width),
        "untangled": untangled(volume, tree, width=width),
        "spiral": spiral(volume, vessel, radius=width, pitch=width / 8),
        "map": lumen_map(volume, vessel, "radius", angle=0.0),
    }
    assert {name: one.pixel_spacing for name, one in made.items()} == dict.fromkeys(made, pytest.approx(side))
    assert straightened_volume(volume, vessel, width).volume.spacing == pytest.approx([side] * 3)


def spacing_of(volume):
    return float(volume.spacing.min())


@pytest.mark.parametrize("command", ["cpr", "cfa", "map", "spiral", "untangled"])
def test_the_shell_has_this_side_too(scan, tmp_path, command):
    volume, vessel, side = scan
    files = [
        write_volume_of(volume, tmp_path / "ct.nii"),
        write_lines(tmp_path / "lines.vtk", vessel.points, float(vessel.radius[0])),
    ]
    words = [command, *map(str, files), "-o", str(tmp_path / "made.png"), "--coordinates", "lps"]
    words += ["--radius", str(vessel.radius[0])] if command == "cfa" else []
    result = CliRunner().invoke(main, words)
    assert f"pixels of {side:g} mm" in result.output


def test_cohorts_have_this_side_too(scan, tmp_path, monkeypatch):
    volume, vessel, side = scan
    made, make = [], CprRequest.of
    monkeypatch.setattr(CprRequest, "of", lambda *given: made.append(make(*given)) or made[-1])
    pictures = Pictures(views=(), looks=(), reformations=("straightened",))
    _pictures(Renderer(volume, VesselTree([vessel]), "cpu"), pictures, tmp_path / "one")
    assert [one.pixel_spacing for one in made] == [pytest.approx(side)]


def test_every_host_states_the_rule():
    words = _lumencut.PIXEL_SIDE
    for command in ("cpr", "cfa", "map", "spiral", "untangled"):
        assert words in " ".join(CliRunner().invoke(main, [command, "--help"]).output.split())
    for function in (cpr, spiral, untangled, lumen_map):
        assert words in " ".join(inspect.getdoc(function).split())
    for page in ("python.md", "reformations.md"):
        assert words in " ".join((Path(__file__).parents[1] / "docs" / page).read_text("utf-8").split())


def test_every_host_states_the_smallest_radius():
    words = _lumencut.SMALLEST_RADIUS
    pages = [
        (Path(__file__).parents[1] / "docs" / page).read_text("utf-8") for page in ("python.md", "cohorts.md")
    ]
    helps = [CliRunner().invoke(main, [command, "--help"]).output for command in ("trace", "render")]
    for text in (*pages, *helps, inspect.getdoc(find_vessels), inspect.getdoc(trace_from)):
        assert words in " ".join(text.split())
    # No number is the default, because the rule needs the voxels.
    for function in (find_vessels, trace_from):
        assert inspect.signature(function).parameters["smallest_radius"].default is None


def test_names_of_methods_are_those_of_the_core():
    assert list(METHODS) == [name for name, _ in _lumencut.STENOSIS_METHODS]
    assert list(GROUPS) == _lumencut.STENOSIS_TERRITORIES
