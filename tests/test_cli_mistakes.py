"""Mistakes of users: options without effect, and volume and centerlines given in the wrong order."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

from lumencut import (
    Camera,
    Renderer,
    Settings,
    TransferFunction,
    VesselTree,
    Window,
    read_centerlines,
    read_volume,
)
from lumencut.cli import main
from lumencut.cli.mistakes import check_options
from lumencut.cli.render import render as command
from lumencut.cli.settings import settings_from
from scene_files import bent_line, write_lines, write_volume
from volume_samples import coded, write_stack

POINTS = TransferFunction([(0, (0, 0, 0), 0), (300, (255, 200, 100), 0.5)])
IDLE = [
    # Options, the words that explain the error, and two values that give the same picture.
    ("--context none", "--context-window 300/100", "with --context none", {"context_window": Window(9, 5)}),
    ("--context none", "--context-step 2", "with --context none", {"context_step": 3.0}),
    ("", "--context-from whole", "without a focus", {"context_from": "whole"}),
    ("--context none", "--context-shading", "with --context none", {"context_shading": True}),
    ("--context none", "--context-preview", "with --context none", {"context_preview": True}),
    ("--context minip", "--context-transfer bone", "grey in its window", {"context_transfer": POINTS}),
    ("--context average", "--context-transfer bone", "grey in its window", {"context_transfer": POINTS}),
    ("--context mip", "--context-shading", "has no surfaces", {"context_shading": True}),
    ("--context minip", "--context-shading", "has no surfaces", {"context_shading": True}),
    ("--context average", "--context-shading", "has no surfaces", {"context_shading": True}),
    *(
        (
            f"--context {name} --context-transfer 0:000000:0,300:ffc864:0.5",
            "--context-window 300/100",
            "their own intensities",
            {"context_window": Window(9, 5)},
        )
        for name in ("dvr", "mip")
    ),
    (
        "--no-silhouettes",
        "--silhouette-rule gradient",
        "without silhouettes",
        {"silhouette_rule": "gradient"},
    ),
    ("--no-silhouettes", "--silhouette-reach 5", "without silhouettes", {"silhouette_reach": 9.0}),
    ("--no-silhouettes", "--silhouette-color ff0000", "without silhouettes", {"silhouette_color": (9, 9, 9)}),
    ("", "--silhouette-slope 2", "with --silhouette-rule leap", {"silhouette_slope": 0.1}),
    ("--no-silhouettes", "--far-rim 0.5", "without silhouettes", {"far_rim": 0.0}),
    ("", "--rim-low 3", "without --rim", {"rim_low": 3.0}),
    ("", "--rim-high 9", "without --rim", {"rim_high": 9.0}),
    ("--no-silhouettes", "--edge-samples 2", "without silhouettes", {"edge_samples": 1}),
    ("--paper", "--edge-samples 2", "with --silhouette-rule gradient", {"edge_samples": 2}),
    ("--samples 2", "--edge-samples 2", "with --samples", {"edge_samples": 1}),
    ("--no-depth-filter", "--zone-filter", "without the depth filter", {"zone_filter": False}),
    ("--no-depth-filter", "--depth-leap 2", "without the depth filter", {"depth_leap": 0.0}),
    ("--no-zone-filter", "--depth-leap 2", "without the zone filter", {"depth_leap": 0.0}),
    ("--levels 0", "--level-distance 2", "with --levels 0", {"level_distance": 0.5}),
    ("--no-lumen-first", "--unknown-radius 2", "without the rule lumen-first", {"unknown_radius": 5.0}),
    (
        "--no-lumen-first --level-choice nearest",
        "--lumen-margin 2",
        "with --level-choice nearest",
        {"lumen_margin": 5.0},
    ),
    ("--paper", "--depth-leap 2", "without the zone filter", {"depth_leap": 0.0}),
    ("--paper", "--lumen-margin 2", "without the rule lumen-first", {"lumen_margin": 5.0}),
]


def invoke(*words):
    return CliRunner().invoke(main, [str(word) for word in words])


def told(result):
    """Return the usage error as one line, however it was wrapped."""
    assert result.exit_code == 2, result.output
    return " ".join(result.stderr.split())


def settings_of(words):
    return settings_from(command.make_context("x", ["v", "c", "-o", "o.png", *words.split()]).params)


@pytest.fixture(scope="module")
def scene(tmp_path_factory):
    """A volume, and lines with and without radii within the volume."""
    folder = tmp_path_factory.mktemp("scene")
    volume = read_volume(write_volume(folder / "ct.nii.gz"))
    rounded = read_centerlines(write_lines(folder / "round.vtk"), "lps")
    bare = read_centerlines(
        write_lines(folder / "bare.vtk", bent_line() + np.array([4, 3, 0]), radius=None), "lps"
    )
    return volume, VesselTree([*rounded, *bare])


@pytest.mark.parametrize(("first", "given", "why", "changes"), IDLE)
@pytest.mark.parametrize("name", ["render", "turntable"])
def test_an_option_that_does_nothing_is_refused_with_the_reason(tmp_path, name, first, given, why, changes):
    result = invoke(name, "a.nii", "b.vtk", "-o", tmp_path / "out.png", *first.split(), *given.split())
    words = told(result)
    assert f"{given.split()[0]} does nothing" in words
    assert why in words
    assert words.endswith(f"or leave out {given.split()[0]}")


@pytest.mark.parametrize(("first", "given", "why", "changes"), IDLE)
def test_it_does_nothing_indeed(scene, first, given, why, changes):
    volume, tree = scene
    settings = settings_of(first)
    renderer = Renderer(volume, tree)
    camera = Camera.fitted(renderer.scene, (0.3, 1, 0.1), (0, 0, 1), (48, 40))
    frames = [renderer.render(camera, one) for one in (settings, replace(settings, **changes))]
    np.testing.assert_array_equal(frames[0].image, frames[1].image)
    np.testing.assert_array_equal(frames[0].depth, frames[1].depth)


def test_one_picture_does_not_turn(tmp_path):
    words = told(invoke("render", "a.nii", "b.vtk", "-o", tmp_path / "out.png", "--turning-limit", "4"))
    assert "--turning-limit does nothing in one picture" in words
    assert "use turntable" in words


CUT_SURFACE = [
    *("--window 900/300", "--opacity 100:200", "--slab 4mm", "--lumen-first", "--lumen-margin 2"),
    *("--preserve-lumen", "--unknown-radius 2", "--cost-weight 3", "--levels 3", "--level-distance 4"),
    *("--level-choice own", "--centerline-smoothing 0.5", "--depth-filter", "--zone-filter"),
    *("--depth-leap 2", "--silhouettes", "--silhouette-rule leap", "--silhouette-color ff0000", "--paper"),
]


@pytest.mark.parametrize("given", CUT_SURFACE)
def test_settings_of_the_cut_surface_need_centerlines(tmp_path, given):
    words = told(invoke("render", "a.nii", "-o", tmp_path / "out.png", *given.split()))
    assert f"{given.split()[0]} does nothing without CENTERLINES: there is no cut surface" in words
    assert ("use --context-window" in words) == given.startswith("--window")


@pytest.mark.parametrize(
    "given",
    [
        "--background 102030 --samples 2",
        "--no-lumen-first --no-silhouettes --no-depth-filter --no-context-shading",
        "--context dvr --context-window 300/100 --context-step 2 --context-shading --context-preview",
    ],
)
def test_what_does_something_or_asks_for_nothing_is_taken_without_centerlines(tmp_path, given):
    words = ["-o", tmp_path / "out.png", "--size", "8x8", *given.split()]
    assert invoke("render", write_volume(tmp_path / "ct.nii"), *words).exit_code == 0
    with Image.open(tmp_path / "out.png") as picture:
        assert picture.size == (8, 8)


def test_the_rules_of_the_paper_can_be_typed_as_its_help_names_them():
    option = next(option for option in command.params if option.name == "paper")
    rules = option.help.partition(": ")[2].partition(".")[0]
    params = command.make_context("x", ["v", "c", "-o", "o.png", *rules.split()]).params
    check_options(params, settings_of(rules), has_centerlines=True)


def test_settings_in_python_stay_silent(scene, capfd):
    volume, tree = scene
    settings = Settings(context=None, context_window=Window(9, 5), silhouette_slope=3, silhouettes=False)
    camera = Camera.fitted(volume, (0, 1, 0), (0, 0, 1), (8, 8))
    Renderer(volume, tree).render(camera, settings)
    Renderer(volume).render(camera, replace(settings, context="mip", slab=None, window=Window(9, 5)))
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize("name", ["render", "turntable", "evaluate"])
def test_options_that_need_radii(tmp_path, name):
    volume, lines = write_volume(tmp_path / "ct.nii"), write_lines(tmp_path / "bare.vtk", radius=None)
    words = [name, volume, lines] + (["-o", tmp_path / "out.png"] if name != "evaluate" else [])
    for option in (["--centerline-smoothing", "0.5"], ["--preserve-lumen"]):
        assert f"{option[0]} does nothing with centerlines without radius" in told(invoke(*words, *option))


@pytest.mark.parametrize("option", ["--series 3", "--phase 2", "--fill-gaps", "--resample-slices"])
def test_options_of_dicom_are_refused_for_other_volumes(tmp_path, option):
    volume, lines = write_volume(tmp_path / "ct.nii.gz"), write_lines(tmp_path / "lines.vtk")
    why = f"{option.split()[0]} does nothing with {volume}, a NIfTI volume: it is for DICOM series"
    for words in (
        ["render", volume, "-o", tmp_path / "out.png"],
        ["evaluate", volume, lines],
        ["info", volume, lines],
    ):
        assert why.replace(" ", "") in told(invoke(*words, *option.split())).replace(" ", "")
    for name in ("evaluate", "info"):
        assert "does nothing without VOLUME" in told(invoke(name, lines, *option.split()))


def test_options_of_dicom_are_taken_where_one_of_the_files_can_be_a_series(tmp_path):
    folder, volume = write_stack(tmp_path / "dicom", coded(), np.eye(4)), write_volume(tmp_path / "ct.nii")
    for files in ([folder], [folder / "IM0001.dcm"], [volume, folder]):
        result = invoke("info", *files, "--fill-gaps", "--resample-slices")
        assert (result.exit_code, "DICOM" in result.output) == (0, True), result.output


@pytest.mark.parametrize("option", ["--coordinates lps", "--unit cm"])
def test_info_refuses_options_of_centerlines_without_any(tmp_path, option):
    words = told(invoke("info", write_volume(tmp_path / "ct.nii"), *option.split()))
    assert f"{option.split()[0]} does nothing without CENTERLINES" in words


@pytest.mark.parametrize("option", ["--window 900/300", "--context mip", "--background 102030"])
def test_an_evaluation_without_pictures_has_no_looks(tmp_path, option):
    words = told(invoke("evaluate", write_lines(tmp_path / "lines.vtk"), *option.split()))
    assert "does nothing without --pictures: it changes no measure" in words


@pytest.mark.parametrize("output", ["frames", "frame-%03d.png"])
@pytest.mark.parametrize("option", ["--fps 5", "--seconds 2"])
def test_single_pictures_have_no_speed(tmp_path, output, option):
    words = told(invoke("turntable", "a.nii", "-o", tmp_path / output, *option.split()))
    assert "--fps and --seconds do nothing with one picture per frame" in words
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ["render", "turntable", "evaluate"])
def test_swapped_files_are_told(tmp_path, name):
    volume, lines = write_volume(tmp_path / "ct.nii.gz"), write_lines(tmp_path / "lines.vtk")
    output = [] if name == "evaluate" else ["-o", tmp_path / "out.png"]
    words = told(invoke(name, lines, volume, *output))
    assert "found VTK PolyData in" in words
    assert "lines.vtk and a NIfTI volume in" in words
    assert "ct.nii.gz; expected VOLUME, then CENTERLINES; swap them" in words
    words = told(invoke(name, volume, volume, *output))
    assert "ct.nii.gz as CENTERLINES; expected VOLUME, then CENTERLINES; give a file of" in words
    words = told(invoke(name, lines, lines, *output))
    if name == "evaluate":
        # Without VOLUME all files are centerlines.
        assert "lines.vtk twice; expected each file of CENTERLINES once" in words
    else:
        assert "lines.vtk as VOLUME; expected VOLUME, then CENTERLINES; name the volume first" in words
    if name != "evaluate":
        assert "; name the volume before it" in told(invoke(name, lines, *output))


def test_a_folder_of_dicom_as_centerlines_is_told(tmp_path):
    folder, lines = write_stack(tmp_path / "dicom", coded(), np.eye(4)), write_lines(tmp_path / "lines.vtk")
    words = told(invoke("render", lines, folder, "-o", tmp_path / "out.png"))
    assert "lines.vtk and a folder in" in words
    assert "dicom; expected VOLUME, then CENTERLINES; swap them" in words
