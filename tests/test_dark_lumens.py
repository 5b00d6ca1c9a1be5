"""Dark lumens in Python and on the command line: traced, measured and shown in the words of airways."""

import numpy as np
import pytest
from click.testing import CliRunner

import lumencut
from lumencut import phantom
from lumencut.cli import main
from lumencut.errors import MeasuringError, SettingsError, TracingError
from scene_files import write_volume_of


@pytest.fixture(scope="module")
def airways():
    return phantom.airways()


@pytest.fixture(scope="module")
def negated():
    """A junction without values below 0, and the same negated."""
    made = phantom.y_junction()
    array = made.volume.array + 100
    grid = {"world_from_index": made.volume.world_from_index}
    return made, lumencut.Volume(array, **grid), lumencut.Volume(-array, **grid)


def airway(made, name):
    return made.tree[[vessel.name for vessel in made.tree].index(name)]


def same(one, other):
    assert len(one) == len(other) > 0
    for a, b in zip(one, other, strict=True):
        assert np.array_equal(a.points, b.points)
        assert np.array_equal(a.radius, b.radius)


def test_a_negated_volume_gives_the_same_lines(negated):
    made, bright, dark = negated
    seed = made.tree[0].points[5]
    points = made.tree[0].points[[3, -3]]
    same(lumencut.find_vessels(bright), lumencut.find_vessels(dark, polarity="dark"))
    same(lumencut.trace_from(bright, seed), lumencut.trace_from(dark, seed, polarity="dark"))
    same(lumencut.trace(bright, points), lumencut.trace(dark, points, polarity="dark"))
    tracer = lumencut.Tracer(dark, polarity="dark")
    for point in points:
        tracer.add(point)
    same(lumencut.trace(bright, points), tracer.tree)


def test_a_mask_is_refined_in_dark_values(negated):
    _, bright, dark = negated
    grid = {"world_from_index": bright.world_from_index}
    mask = lumencut.Volume((bright.array > 230).astype(np.uint8), **grid)
    refined = lumencut.trace_mask(mask, dark, polarity="dark")
    same(lumencut.trace_mask(mask, bright), refined)
    assert all(vessel.confidence is not None for vessel in refined)
    assert all(vessel.confidence is None for vessel in lumencut.trace_mask(mask, dark))


def test_a_dark_scan_is_refused_in_words_of_dark_lumens(negated):
    _, bright, _ = negated
    with pytest.raises(TracingError, match=r"no dark lumen found.*darker than the tissue around them"):
        lumencut.find_vessels(bright, polarity="dark")
    with pytest.raises(SettingsError, match=r"'light'.*'bright', 'dark'"):
        lumencut.find_vessels(bright, polarity="light")


def test_notes_state_the_values_of_the_volume_and_name_airways(airways):
    tree = lumencut.trace_from(airways.volume, airway(airways, "trachea").points[8], polarity="dark")
    assert tree.notes[0].startswith("the lumen of the airways has about -99")
    assert not any("vessel " in note.replace("vessel 0", "") for note in tree.notes[:1])
    assert lumencut.compare_centerlines(tree, airways.tree).false_length < 0.02 * sum(
        vessel.length for vessel in airways.tree
    )


def test_measuring_finds_the_wall_and_refuses_another_polarity(airways):
    trachea = airway(airways, "trachea")
    profile = lumencut.measure(airways.volume, trachea, step=2, polarity="dark")
    assert np.nanmedian(profile.wall) == pytest.approx(1.5, abs=0.08)
    assert np.nanmedian(profile.diameter_equivalent) == pytest.approx(12, abs=0.05)
    with pytest.raises(MeasuringError, match=r"darker than its surroundings.*bright"):
        lumencut.measure(airways.volume, trachea, step=2, polarity="bright")
    with pytest.raises(SettingsError, match="polarity"):
        lumencut.measure(airways.volume, trachea, polarity="grey")


def run(*arguments):
    return CliRunner().invoke(main, ["trace", *map(str, arguments)])


def test_the_command_line_traces_airways(airways, tmp_path):
    scan = write_volume_of(airways.volume, tmp_path / "chest.nii.gz")
    seed = ",".join(f"{x:.2f}" for x in airway(airways, "trachea").points[8])
    picture, lines = tmp_path / "airways.png", tmp_path / "lines.vtp"
    done = run(scan, "--dark", "--seed", seed, "-o", lines, "--preview", picture)
    assert done.exit_code == 0, done.output
    assert "lumen of the airways has about -99" in done.output
    assert len(lumencut.read_centerlines(lines)) > 20
    assert picture.stat().st_size > 10_000
    refused = run(scan, "--seed", seed, "-o", lines)
    assert refused.exit_code == 1
    assert "no vessel" in refused.output or "a doubtful vessel" in refused.output
    mask = run("--mask", scan, "--dark", "-o", lines)
    assert mask.exit_code == 2
    assert "--dark without VOLUME does nothing" in mask.output
