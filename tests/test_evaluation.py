"""`evaluate`, its results, and `lumencut evaluate`."""

import csv
import re
from dataclasses import replace

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

import lumencut
from evaluation_scenes import EXACT, crossing_tubes, tube
from lumencut import (
    CameraError,
    Renderer,
    Settings,
    SettingsError,
    Vessel,
    VesselTree,
    VesselTreeError,
    Volume,
    VolumeError,
    _lumencut,
    evaluate,
)
from lumencut.cli import main
from lumencut.evaluation.methods import METHODS, USUAL
from scene_files import write_lines, write_volume
from scenes import wandering

SMALL = {"views": 4, "size": (96, 96)}


@pytest.fixture(scope="module")
def block():
    """A volume around the crossing tubes, with a value in every voxel."""
    return Volume(np.full((8, 8, 8), 100, np.int16), spacing=(10, 10, 10), origin=(-35, -30, -35))


def alone(volume=None, tree=None, settings=EXACT, **more):
    """Return the row of the method csr."""
    (row,) = evaluate(
        volume, tree or crossing_tubes(), ("csr",), settings=settings, **{**SMALL, **more}
    ).table
    return row


def test_a_straight_tube_is_shown_as_it_is():
    # The tube is 19.5 pixels wide: it covers 19 or 20 pixel centres, depending on its position.
    row = alone(tree=VesselTree([tube(4.875)]), pixel_spacing=0.5, size=(200, 200))
    for name in ("visible_centerline", "lumen_within_0.05_mm", "lumen_within_0.5_mm", "lumen_within_2_mm"):
        assert row[f"{name}_percent"] == 100, name
    assert row["width_error_mean_mm"] <= 0.26
    assert row["width_stations"] > 10
    assert row["crossings"] == row["hidden_centerline_points"] == 0
    assert row["crossings_in_order_percent"] is None
    assert row["zone_changes_per_degree_percent"] == 0


def test_without_levels_and_filter_lumen_first_shows_every_lumen():
    tree = wandering(4, vessels=12)
    row = alone(tree=tree)
    assert row["visible_centerline_percent"] > 99.9
    assert row["lumen_within_0.05_mm_percent"] > 99.9
    assert row["crossings_in_order_percent"] == 100
    assert row["crossings"] > 5
    paper = alone(tree=tree, settings=Settings.paper())
    assert paper["lumen_within_0.05_mm_percent"] < 95
    assert paper["visible_centerline_percent"] < row["visible_centerline_percent"]


def test_crossing_tubes_by_cost_show_less_of_the_one_behind():
    """By cost the front tube extends 20 mm / λ = 2 mm beyond its wall, into the lumen of the other tube."""
    front = {"views": 1, "size": (401, 401), "pixel_spacing": 0.2}
    cost = alone(settings=replace(EXACT, lumen_first=False), **front)
    assert alone(settings=EXACT, **front)["lumen_within_0.05_mm_percent"] == 100
    # It loses two bands of 2 mm by 6 mm. The total is both tubes with round ends, minus the hidden part.
    lumen = 60 * 8 + np.pi * 16 + 60 * 6 + np.pi * 9 - 8 * 6
    assert cost["lumen_within_0.05_mm_percent"] == pytest.approx(100 * (1 - 2 * 2 * 6 / lumen), abs=0.3)
    assert cost["visible_centerline_percent"] == pytest.approx(100 * (1 - 4 / (122 - 9)))


def test_surroundings_are_where_the_volume_is(block):
    front = {"views": 1, "size": (100, 100), "pixel_spacing": 2.0}
    assert alone(block, **front)["tissue_percent"] == pytest.approx(16, abs=1)
    assert alone(None, **front)["tissue_percent"] is None


@pytest.mark.parametrize("radius", [None, 0.0])
def test_vessels_without_radius(radius):
    tree = VesselTree([Vessel(vessel.points, radius) for vessel in crossing_tubes()])
    thin, thick = (alone(tree=tree, settings=replace(EXACT, unknown_radius=r)) for r in (1.0, 5.0))
    assert thick["lumen_pixels"] > 3 * thin["lumen_pixels"]
    unfiltered = alone(tree=tree, settings=Settings(depth_filter=False))
    for row in (thin, thick, unfiltered):
        assert row["visible_centerline_percent"] == row["lumen_within_0.05_mm_percent"] == 100
    by_cost = alone(tree=tree, settings=Settings.paper(depth_filter=False))
    assert by_cost["lumen_within_0.05_mm_percent"] < 98
    assert alone(tree=tree, settings=replace(EXACT, unknown_radius=0))["lumen_pixels"] < 200


def test_one_pixel_and_a_vessel_along_the_view():
    row = alone(tree=VesselTree([Vessel([(0, -30, 0), (0, 30, 0)], 3.0)]), views=1, size=(1, 1))
    assert row["lumen_within_0.05_mm_percent"] == 100
    assert row["width_stations"] == 0


def test_images_that_a_method_gives_become_numbers(monkeypatch):
    shape = SMALL["size"]
    images = {"strength": np.ones(shape, np.float32), "sheet_gap": np.full(shape, 30, np.float32)}
    monkeypatch.setitem(METHODS, "csr", replace(METHODS["csr"], details=lambda *_: images))
    row = alone()
    assert row["leaps"] > 50
    assert row["leaps_with_line_percent"] == row["blended_sheets_percent"] == 100
    monkeypatch.setitem(METHODS, "csr", replace(METHODS["csr"], details=lambda *_: {}))
    row = alone()
    assert row["leaps"] is row["blended_sheets_percent"] is None


def test_lines_of_the_rule_leap_are_at_leaps_and_nowhere_else():
    everywhere = Settings(silhouette_reach=None)
    row, paper = evaluate(None, crossing_tubes(), ("csr", "csr-paper"), settings=everywhere, **SMALL).table
    (drawn,) = evaluate(None, crossing_tubes(), ("csr",), **SMALL).table
    assert row["leaps"] == drawn["leaps"] > 50
    assert row["leaps_with_line_percent"] > 95
    # With its reach, the default leaves out lines far from vessels.
    assert row["leaps_with_line_percent"] > drawn["leaps_with_line_percent"] > 80
    assert paper["leaps"] > 50
    assert row["leaps_with_line_percent"] >= paper["leaps_with_line_percent"]
    assert row["lines_elsewhere_mm_per_mm2"] < 0.001


def test_a_straight_upright_vessel_is_the_same_by_all_methods():
    """All methods cut it along the plane in which it lies, wherever rows cross it."""
    tree = VesselTree([tube(4.875, axis=2)])
    found = evaluate(None, tree, views=1, size=(200, 110), pixel_spacing=0.5, settings=EXACT)
    for row in found.table:
        for name in ("lumen_within_0.05_mm", "lumen_shown", "visible_centerline"):
            assert row[f"{name}_percent"] == 100, (row["method"], name)
        assert row["unbroken_surroundings_percent"] == 100
        assert row["width_error_mean_mm"] == found.table[0]["width_error_mean_mm"]
        assert row["leaps"] == 0


def test_a_vessel_along_the_rows_is_too_thin_by_mpcpr_and_as_wide_as_it_is_by_the_others():
    """45 degrees out of the plane and 20 degrees to the rows: 8 mm appear as 8·sin 20° / √(1 − dx²)."""
    phi, theta = np.radians([20, 45])
    along = np.array([np.cos(phi) * np.cos(theta), np.sin(theta), np.sin(phi) * np.cos(theta)])
    tree = VesselTree([Vessel(along * np.linspace(-50, 50, 101)[:, None], 4.0)])
    found = evaluate(None, tree, views=1, size=(600, 300), pixel_spacing=0.2, settings=EXACT)
    bias = {row["method"]: row["width_bias_mm"] for row in found.table}
    expected = 8 * np.sin(phi) / np.sqrt(1 - along[0] ** 2) - 8
    assert expected < -4
    assert bias["mpcpr"] == bias["cpr"] == pytest.approx(expected, abs=0.25)
    for name in ("csr", "csr-paper", "cr"):
        assert bias[name] == pytest.approx(0, abs=0.2), name


def test_of_two_crossing_tubes_each_method_shows_what_it_can():
    """The upright tube lies 20 mm behind the horizontal one; mpCPR does not know which one is in front."""
    front = {"views": 1, "size": (161, 161), "pixel_spacing": 0.5}
    rows = {row["method"]: row for row in evaluate(None, crossing_tubes(), settings=EXACT, **front).table}
    assert rows["csr"]["lumen_shown_percent"] == rows["cpr"]["visible_centerline_percent"] == 100
    assert rows["csr"]["crossings_in_order_percent"] == rows["cr"]["crossings_in_order_percent"] == 100
    # A disc of 50 pixels of 0.5 mm around the front tube leaves 30 − 4 − 25 mm at both ends of the other.
    assert rows["cr"]["lumen_shown_percent"] < 75 < rows["csr-paper"]["lumen_shown_percent"]
    # Each tube has its own image: all of it is visible, and no other tube crosses it.
    assert rows["cpr"]["hidden_centerline_points"] == 0
    assert (rows["cpr"]["crossings"], rows["csr"]["crossings"]) == (0, 1)
    assert rows["cpr"]["centerline_points"] == 122


def test_vessels_beside_the_volume_have_an_image_too(block):
    tree = VesselTree([*crossing_tubes(), Vessel([(500, 0, 0), (500, 0, 20)], 2.0)])
    (row,) = evaluate(block, tree, ("cpr",), **SMALL).table
    assert row["tissue_percent"] > 0


def test_methods_differ_in_their_settings_alone():
    chosen = Settings(lumen_first=True, lumen_margin=3, cost_weight=20, levels=2)
    found = evaluate(None, crossing_tubes(), settings=chosen, **SMALL)
    assert found.settings["csr"] == chosen
    assert found.settings["csr-paper"] == Settings.paper(cost_weight=20, levels=2)
    assert _lumencut.PAPER.items() <= vars(found.settings["csr-paper"]).items()
    only = evaluate(None, crossing_tubes(), methods="csr-paper", settings=chosen, **SMALL)
    assert only.table == found.table[1:2]
    assert all(found.settings[name] == chosen for name in ("cpr", "mpcpr", "cr"))


def test_there_is_a_row_for_each_method_and_for_each_view():
    found = evaluate(None, crossing_tubes(), **SMALL)
    assert [row["method"] for row in found.table] == list(USUAL)
    assert list(USUAL) == ["csr", "csr-paper", "cpr", "mpcpr", "cr"]
    assert [row["views"] for row in found.table] == [4] * 5
    assert [(row["method"], row["view"]) for row in found.views] == [(m, v) for m in USUAL for v in range(4)]
    assert len(found.cameras) == 4
    pixels = sum(row["lumen_pixels"] for row in found.views if row["method"] == "csr")
    assert pixels == found.table[0]["lumen_pixels"]
    worst = [row["lumen_within_0.05_mm_percent"] for row in found.views[:4]]
    assert found.worst_view("csr") == worst.index(min(worst))
    assert repr(found) == "Evaluation(csr, csr-paper, cpr, mpcpr, cr: 4 views)"
    again = evaluate(None, crossing_tubes(), **SMALL)
    assert (again.table, again.views) == (found.table, found.views)


def test_pixels_have_the_given_spacing():
    found = evaluate(None, crossing_tubes(), views=3, size=(40, 30), pixel_spacing=0.4)
    assert {(camera.size, camera.pixel_spacing) for camera in found.cameras} == {((40, 30), 0.4)}


@pytest.mark.parametrize(
    ("arguments", "error", "words"),
    [
        (
            {"methods": ("csr", "mip")},
            SettingsError,
            "found 'mip'; expected one of 'csr', 'csr-paper', 'cpr'",
        ),
        ({"methods": ()}, SettingsError, "no method"),
        ({"methods": ("csr", "csr")}, SettingsError, "csr, csr"),
        ({"methods": 3}, SettingsError, "methods: found 3"),
        ({"views": 0}, SettingsError, "views: found"),
        ({"views": 2.5}, SettingsError, "views: found"),
        ({"settings": {}}, SettingsError, "dict"),
        ({"size": (0, 5)}, CameraError, "size"),
        ({"pixel_spacing": -1}, CameraError, "pixel_spacing"),
        ({"tree": None}, VesselTreeError, "NoneType"),
        ({"volume": "ct.nii"}, VolumeError, "found builtins.str"),
        ({"device": "tpu"}, SettingsError, "tpu"),
    ],
)
def test_bad_arguments_are_named(arguments, error, words):
    with pytest.raises(error, match=re.escape(words)):
        evaluate(**{"volume": None, "tree": crossing_tubes(), **arguments})


def test_progress_and_cancelling():
    told = []

    def stop(done, total):
        told.append((done, total))
        if done == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        evaluate(None, crossing_tubes(), progress=stop, **SMALL)
    assert told == [(1, 20), (2, 20), (3, 20)]


@pytest.fixture
def found(block):
    return evaluate(block, crossing_tubes(), **SMALL)


def test_the_table_as_csv(found, tmp_path):
    found.to_csv(tmp_path / "table.csv")
    with (tmp_path / "table.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert [row["method"] for row in rows] == list(USUAL)
    assert float(rows[0]["tissue_percent"]) == found.table[0]["tissue_percent"]
    assert int(rows[0]["leaps"]) == found.table[0]["leaps"]
    with pytest.raises(lumencut.FileError, match="nowhere"):
        found.to_csv(tmp_path / "nowhere" / "table.csv")
    assert [path.name for path in tmp_path.iterdir()] == ["table.csv"]


def test_the_table_as_markdown(found):
    lines = found.to_markdown().splitlines()
    assert re.fullmatch(r"\| method +\| +csr \| csr-paper \| +cpr \| +mpcpr \| +cr \|", lines[0])
    assert re.fullmatch(r"\| -+ (\| -+: ){5}\|", lines[1])
    assert len({len(line) for line in lines}) == 1
    names = [line.split("|")[1].strip() for line in lines[2:]]
    groups = ["lumen", "surroundings", "visibility", "depth", "silhouettes"]
    assert [name for name in names if "*" in name] == [f"**{group}**" for group in groups]
    assert [name for name in names if "*" not in name] == list(found.table[0])[1:]
    firsts = [names[names.index(f"**{group}**") + 1] for group in groups]
    expected = ["lumen_within_0.05_mm", "tissue", "lumen_shown", "crossings_in_order", "leaps_with_line"]
    assert firsts == [f"{name}_percent" for name in expected]
    assert re.search(r"\| leaps +(\| +\d+ ){5}\|", lines[-1])


def test_pictures_of_the_worst_views(found, block, tmp_path):
    paths = found.save_pictures(tmp_path / "worst")
    assert [path.name for path in paths] == [f"{name}.png" for name in USUAL]
    expected = Renderer(block, crossing_tubes()).render(found.cameras[found.worst_view("csr")], Settings())
    assert np.array_equal(np.asarray(Image.open(paths[0])), expected.image)
    (tmp_path / "file").write_text("")
    with pytest.raises(lumencut.FileError, match="file"):
        found.save_pictures(tmp_path / "file")
    with pytest.raises(VolumeError, match="no volume"):
        evaluate(None, crossing_tubes(), **SMALL).save_pictures(tmp_path / "none")
    assert not (tmp_path / "none").exists()


@pytest.fixture
def scene(tmp_path):
    (tmp_path / "in").mkdir()
    return [str(write_volume(tmp_path / "in/ct.nii.gz")), str(write_lines(tmp_path / "in/lines.vtk"))]


def run(*words):
    return CliRunner().invoke(main, ["evaluate", *words, "--views", "2", "--size", "32x32"])


def test_the_command_prints_markdown(scene):
    for files, tissue in ((scene, r"\d"), (scene[1:], "-")):
        result = run(*files, "--levels", "0", "--methods", "csr")
        assert result.exit_code == 0, result.output
        assert result.stdout.startswith("| method ")
        assert re.search(rf"\| tissue_percent +\| +{tissue}", result.stdout)


def test_the_command_writes_files(scene, tmp_path):
    names = [tmp_path / name for name in ("out.csv", "out.md", "worst")]
    result = run(
        *scene,
        "--csv",
        str(names[0]),
        "--markdown",
        str(names[1]),
        "--pictures",
        str(names[2]),
        "--lumen-first",
    )
    assert result.exit_code == 0, result.output
    assert names[0].read_text().startswith("method,views,lumen_within_0.05_mm_percent,")
    assert names[1].read_text().startswith("| method ")
    assert sorted(path.name for path in names[2].iterdir()) == sorted(f"{name}.png" for name in USUAL)
    assert [line.partition(":")[0] for line in result.stdout.splitlines()[:2]] == list(map(str, names[:2]))
    assert "| method" not in result.stdout


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["a", "--methods", "csr,mip"], "found 'mip'"),
        (["a", "--methods", ","], "no method"),
        (["a", "--pictures", "x"], "--pictures without VOLUME"),
        (["a", "--fill-gaps"], "--fill-gaps does nothing without VOLUME"),
        (["a", "--series", "1"], "--series does nothing without VOLUME"),
        (["a", "--csv", "nowhere/x.csv"], "no folder nowhere"),
        (["a", "--levels", "99"], "levels"),
        (["nowhere.vtp"], "nowhere.vtp: found No such file"),
    ],
)
def test_the_command_says_what_is_wrong_before_it_works(words, message):
    result = run(*words)
    assert result.exit_code in (1, 2)
    assert message in result.stderr
    assert result.stdout == ""


def test_ctrl_c_leaves_nothing_behind(scene, tmp_path, monkeypatch):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(Renderer, "cut_surface", interrupted)
    result = run(scene[1], "--csv", str(tmp_path / "out.csv"))
    assert result.exit_code == 130
    assert "interrupted" in result.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["in"]
