"""Stenoses, lengths and angles on known vessels, and errors."""

import numpy as np
import pytest

from lumencut import MeasuringError, SettingsError, Vessel, Volume, measure, phantom
from lumencut.measuring.profile import Profile, Spot
from measure_scenes import FWHM, Grid, narrowed, round_tube


@pytest.fixture(scope="module")
def half() -> Profile:
    return measure(*narrowed(50), fwhm=FWHM)


def test_ecst_is_of_the_original_diameter_that_is_assumed(half):
    graded = half.stenosis(30, method="ecst", original=6.25)
    assert graded.reference == 6.25
    assert graded.references == ()
    assert graded.percent == pytest.approx(100 * (1 - graded.diameter / 6.25))
    assert "assumed original 6.25 mm" in str(graded)


def test_no_percentage_without_method_reference_and_mm(half):
    text = str(half.stenosis(30, 45))
    for part in ("50 ± 1 %", "NASCET", "of the diameter", "mm at 30.0 mm", "reference", "45.0 mm"):
        assert part in text
    assert "area" in str(half.stenosis(30, 45, "area"))


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((-1, 45), "place on the vessel: found -1 mm; expected an arc length from 0 to 60"),
        ((30, 61), "reference of the stenosis: found 61 mm; expected an arc length from 0 to 60"),
        ((30, np.nan), "reference of the stenosis: found NaN"),
        ((30,), "reference of the stenosis: found 0 places"),
        ((30, (1, 2, 3)), "reference of the stenosis: found 3 places"),
        ((30, (40, 45)), "one place before it and one after it"),
        ((45, 45), r"found 45\.0 mm, 0\.0 mm from the stenosis at 45\.0 mm.*at least one diameter of"),
        ((30, 34, "area"), r"found 34\.0 mm, 4\.0 mm from the stenosis.*mark the reference farther from"),
        ((30, (10, 34)), r"found 34\.0 mm, 4\.0 mm from the stenosis.*mark the reference farther from"),
        (
            (45, 30),
            r"reference of the stenosis: found 2\.\d+ mm, the median within 1.5 mm, but the stenosis",
        ),
        ((30, 45, "ecst"), "original diameter of the stenosis: found none"),
        ((30, 45, "ecst", 0.0), "original diameter of the stenosis: found 0 mm"),
        ((30, 45, "ecst", 1.0), "reference of the stenosis: found 1.00 mm"),
        ((30, 45, "nascet", 5.0), "original diameter of the stenosis: found 5.0"),
        (("here", 45), "place of the stenosis: found 'here'"),
    ],
)
def test_what_makes_no_sense_is_refused(half, arguments, message):
    with pytest.raises(MeasuringError, match=message):
        half.stenosis(*arguments)


def test_unknown_methods_and_vessels_are_refused(half):
    with pytest.raises(SettingsError, match="one of 'nascet', 'ecst', 'area'"):
        half.stenosis(30, 45, "who")
    with pytest.raises(SettingsError, match="one of 'carotid', 'coronary'"):
        half.stenosis(30, 45).group("aorta")
    with pytest.raises(MeasuringError, match="method of the stenosis: found 'area'"):
        half.stenosis(30, 45, "area").group("carotid")


def test_nascet_is_refused_at_a_near_occlusion(half):
    assert half.stenosis(30, 45, comparison=5.5).percent > 40
    with pytest.raises(MeasuringError, match="near-occlusion"):
        half.stenosis(30, 45, comparison=6.0)
    # ... and if the vessel is less than half as wide as before the stenosis.
    grid = Grid.even((0.5, 0.5, 0.5), (15, 15, 64))
    x, y, z = grid.points(1)
    radius = np.where(z < -2, 3.0, np.where(z < 2, 0.9, 1.3))
    values = np.clip(0.5 - (np.hypot(x, y) - radius) / 0.5, 0, 1) * 300
    line = np.linspace([0, 0, -30], [0, 0, 30], 121)
    profile = measure(Volume(values.astype(np.float32), world_from_index=grid.affine), Vessel(line), fwhm=0.5)
    with pytest.raises(MeasuringError, match=r"near-occlusion.*state only the diameter in mm"):
        profile.stenosis(30, 45)
    assert profile.stenosis(30, 45, "area").percent > 0


@pytest.mark.parametrize(
    ("vessel", "text"),
    [("carotid", "50 to 69 % (groups of NASCET"), ("coronary", "50 to 69 %: CAD-RADS 3")],
)
def test_groups_are_those_of_the_field(half, vessel, text):
    graded = half.stenosis(30, 45)
    expected = text if round(graded.percent) >= 50 else text.replace("50 to 69", "below 50")
    group = graded.group(vessel)
    assert round(graded.percent) < 50 or group.startswith(expected)
    assert "N Engl J Med" in group or "doi:" in group


def test_references_are_suggested_on_both_sides_or_not_at_all(half):
    before, after = half.suggested_references(30)
    assert isinstance(before, Spot)
    assert isinstance(after, Spot)
    assert before.arc_length < 30 < after.arc_length
    assert half.suggested_references(0)[0] is None
    with pytest.raises(MeasuringError, match="place on the vessel: found 99 mm"):
        half.suggested_references(99)


@pytest.fixture(scope="module")
def bent() -> Profile:
    """A vessel of 20 mm in the direction (1, 0, 1), then 20 mm in (0, 1, 1)."""
    ahead = [np.array([1, 0, 1]) / np.sqrt(2), np.array([0, 1, 1]) / np.sqrt(2)]
    line = np.concatenate(
        [np.linspace(-20, 0, 41)[:, None] * ahead[0], np.linspace(0.5, 20, 40)[:, None] * ahead[1]]
    )
    sides = round_tube(4.0)
    grid = Grid.even((0.5, 0.5, 0.5), (40, 40, 40))
    points = np.moveaxis(grid.points(1), 0, -1)
    middle = np.array([-14.0, 14.0, 0.0]) / 2
    away = np.full(points.shape[:3], np.inf)
    for start, end in ((line[0], 0 * middle), (0 * middle, line[-1])):
        along = (end - start) / np.linalg.norm(end - start)
        t = np.clip((points - start) @ along, 0, 20)
        away = np.minimum(away, np.linalg.norm(points - start - t[..., None] * along, axis=-1))
    values = np.clip(0.5 - (away - sides.diameters[0] / 2) / 0.5, 0, 1) * 300
    return measure(Volume(values.astype(np.float32), world_from_index=grid.affine), Vessel(line), fwhm=0.5)


def test_lengths_and_angles(bent):
    stretch = bent.stretch(0, 40)
    assert stretch.length == pytest.approx(40, rel=0.002)
    assert stretch.straight == pytest.approx(np.sqrt(3) * 20, rel=0.002)
    assert stretch.tortuosity == pytest.approx(2 / np.sqrt(3), rel=0.003)
    assert bent.stretch(35, 5).length == pytest.approx(30, rel=0.002)
    angle = bent.angle_between((2, 16), (24, 38))
    assert angle.degrees == pytest.approx(60, abs=1)
    assert float(angle) == pytest.approx(np.pi / 3, abs=0.02)
    assert bent.angle_between((2, 16), (16, 2)).degrees == pytest.approx(180, abs=0.01)
    assert bent.direction(2, 16) == pytest.approx(np.array([1, 0, 1]) / np.sqrt(2), abs=0.02)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda p: p.stretch(3, 3), "ends of the stretch: found 3 mm twice"),
        (lambda p: p.stretch(3, 41), "end of the stretch: found 41 mm; expected an arc length from 0 to 40"),
        (lambda p: p.angle_between((0, 1, 2), (3, 4)), "ends of the stretch: found"),
        (lambda p: p.c_arm(0, 5, np.inf), "rotation of the C-arm"),
        (lambda p: p.diameter_at("x"), "place on the vessel: found 'x'"),
    ],
)
def test_stretches_that_are_none_are_refused(bent, call, message):
    with pytest.raises(MeasuringError, match=message):
        call(bent)


BETWEEN = "A branch lies between the place and a reference: beyond it a vessel may be of another width."


@pytest.fixture(scope="module")
def past_a_junction() -> Profile:
    """A trunk of 10.6 mm that becomes a narrower branch 30 mm from its start."""
    scene = phantom.y_junction()
    return measure(scene.volume, scene.tree.path([0, 1]), tree=scene.tree)


def test_a_percentage_tells_what_makes_it_doubtful(past_a_junction, half):
    assert half.stenosis(30, 45).doubts == ()
    for at, doubts in ((50, (BETWEEN,)), (36, ("At these places: branch, vessel beside.", BETWEEN))):
        graded = past_a_junction.stenosis(at, 10)
        assert graded.doubts == doubts
        assert str(graded).endswith(f"mm at 10.0 mm. {' '.join(doubts)}")
    assert past_a_junction.stenosis(50, 10, "ecst", 12.0).doubts == ()
