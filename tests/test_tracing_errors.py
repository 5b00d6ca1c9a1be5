"""Errors of tracing for points outside lumen, and for points that no lumen connects."""

import re
import signal
import threading

import numpy as np
import pytest

from lumencut import Tracer, TracingError, Volume, VolumeError, trace
from trace_scenes import BONE, FAT, LUMEN, Scene, arc, away, beside, room


@pytest.fixture(scope="module")
def scene():
    """A vessel in fat next to a muscle, an air bubble and a bone, and a separate second vessel."""
    line = arc(60)
    made = Scene(room(line, 0.6, 18), (0.6,) * 3)
    made.values[:] = FAT
    for angle, value in ((0.5, 55.0), (2.0, -1000.0), (3.5, BONE)):
        made.paint(beside(line, 8.0, angle, 20, 40), 3.0, value)
    made.paint(line, 2.5, LUMEN)
    made.paint(beside(line, 13.0, 5.0, 5, 55), 2.5, LUMEN)
    return line, made.volume(2)


@pytest.mark.parametrize(
    ("angle", "away", "words"),
    [
        (0.5, 8.0, "soft tissue, or blood without contrast medium"),
        (2.0, 8.0, "air"),
        (3.5, 8.0, "bone, metal or calcium"),
        (5.0, 6.0, "fat"),
    ],
)
@pytest.mark.parametrize("is_first", [True, False])
def test_a_click_beside_the_lumen_is_told_what_it_hit_and_where_lumen_is(scene, angle, away, words, is_first):
    line, volume = scene
    click = beside(line, away, angle, 29, 31)[2]
    clicks = [click, line[-6]] if is_first else [line[5], click]
    with pytest.raises(TracingError) as raised:
        trace(volume, clicks)
    text = str(raised.value)
    assert words in text
    assert f"({click[0]:.1f}, {click[1]:.1f}, {click[2]:.1f})" in text
    value = float(re.search(r"about (-?\d+) around it", text)[1])
    assert value == pytest.approx(float(volume.sample([click])[0]), abs=60)
    nearest = re.search(r"looks like lumen is \((.*?)\) mm, ([\d.]+) mm away", text)
    place = np.array([float(x) for x in nearest[1].split(",")])
    assert volume.sample([place])[0] > 200
    assert np.linalg.norm(place - click) == pytest.approx(float(nearest[2]), abs=0.15)


@pytest.fixture(scope="module")
def without_air():
    """A vessel next to muscle, an air bubble, a bone and weakly enhanced tissue; without fat."""
    line = arc(60)
    made = Scene(room(line, 0.6, 18), (0.6,) * 3)
    for angle, value in ((0.5, 80.0), (1.75, 0.0), (3.0, 1600.0), (4.5, 110.0)):
        made.paint(beside(line, 8.0, angle, 20, 40), 3.0, value)
    made.paint(line, 2.5, LUMEN)
    return line, made.volume(2)


@pytest.mark.parametrize(
    ("angle", "words"), [(0.5, "tissue"), (1.75, "tissue"), (3.0, "far brighter"), (4.5, "tissue")]
)
@pytest.mark.parametrize("before", [1, 2])
def test_of_clicks_unlike_each_other_the_one_that_is_no_lumen_is_named(without_air, angle, words, before):
    line, volume = without_air
    click = beside(line, 8.0, angle, 29, 31)[2]
    with pytest.raises(TracingError, match=words) as raised:
        trace(volume, [*line[[5, 60][:before]], click])
    assert f"point ({click[0]:.1f}, {click[1]:.1f}, {click[2]:.1f}) mm: found" in str(raised.value)


@pytest.mark.parametrize("angle", [0.5, 1.75, 4.5])
def test_a_first_click_that_is_no_brighter_than_what_is_around_is_named(without_air, angle):
    line, volume = without_air
    click = beside(line, 8.0, angle, 29, 31)[2]
    with pytest.raises(TracingError) as raised:
        trace(volume, [click, line[-6], line[60]])
    assert f"point ({click[0]:.1f}, {click[1]:.1f}, {click[2]:.1f}) mm: found" in str(raised.value)


def test_a_click_that_was_refused_does_not_mislead_the_next_ones(without_air):
    line, volume = without_air
    tracer = Tracer(volume)
    tracer.add(line[5])
    tracer.add(beside(line, 8.0, 0.5, 29, 31)[2])
    with pytest.raises(TracingError, match="tissue"):
        _ = tracer.tree
    tracer.move(1, line[-6])
    assert tracer.tree == trace(volume, [line[5], line[-6]])


@pytest.mark.parametrize("end", [200.0, 150.0])
def test_a_darker_click_is_accepted_where_contrast_fades(end):
    line = arc(60)
    made = Scene(room(line, 0.6, 18), (0.6,) * 3)
    made.paint(line, 2.5, np.linspace(LUMEN, end, len(line)))
    (vessel,) = trace(made.volume(2), [line[5], line[-6]])
    assert away(vessel.points, line).max() < 0.3


def test_vessels_that_do_not_meet_are_never_joined_by_a_straight_line(scene):
    line, volume = scene
    other = beside(line, 13.0, 5.0, 5, 55)
    with pytest.raises(TracingError) as raised:
        trace(volume, [line[5], other[-8]])
    text = str(raised.value)
    length = float(re.search(r"found ([\d.]+) mm between them", text)[1])
    # The vessels are 13 mm apart; each end of this path has 2.5 mm of lumen.
    assert 7 < length < 11
    x, y, z, value = re.search(
        r"least at \((.*?), (.*?), (.*?)\) mm, where the volume has (-?\d+)", text
    ).groups()
    assert volume.sample([[float(x), float(y), float(z)]])[0] == pytest.approx(float(value), abs=60)
    assert float(value) < 100
    assert "expected lumen of about 3" in text


def test_an_artery_and_a_vein_a_millimetre_apart_are_told_apart():
    line = arc(60)
    vein = beside(line, 2.5 + 1 + 4, 2.0, 2, 58)
    made = Scene(room(line, 0.6, 18), (0.6,) * 3)
    made.paint(line, 2.5, LUMEN)
    made.paint(vein, 4.0, LUMEN - 20)
    with pytest.raises(TracingError, match="do not look like lumen"):
        trace(made.volume(1), [line[5], vein[-20]])


def test_without_contrast_medium_nothing_is_traced():
    line = arc(60)
    made = Scene(room(line, 0.8), (0.8,) * 3)
    made.paint(line, 2.5, 55.0)
    with pytest.raises(TracingError, match="without signal"):
        trace(made.volume(1), [line[5], line[-6]])


@pytest.mark.parametrize(
    ("points", "words"),
    [
        ([], "none"),
        ([[0, 0, 0]], "1 point"),
        ([[[0, 0, 0]], [[0, 0, 0], [1, 1, 1]]], "points of vessel 0: found 1 point"),
        ([[0, 0], [1, 1]], "shape"),
        ([[0, 0, 0], [0, 0, np.nan]], "finite"),
        ("here", "points"),
        (7, "points of shape"),
    ],
)
def test_points_that_are_none_are_refused(scene, points, words):
    with pytest.raises(TracingError, match=words):
        trace(scene[1], points)


def test_points_outside_the_volume_and_equal_points_are_named(scene):
    line, volume = scene
    with pytest.raises(
        TracingError, match=r"point 1 of vessel 0: found .*outside the volume; expected a point between"
    ):
        trace(volume, [line[5], line[5] + [500, 0, 0]])
    with pytest.raises(TracingError, match="points 1 and 2, both"):
        trace(volume, [line[5], line[-6], line[-6]])


def test_a_stopper_across_the_only_vessel_leaves_no_way(scene):
    line, volume = scene
    with pytest.raises(TracingError, match=r"do not look like lumen|no path between them"):
        trace(volume, [line[5], line[-6]], [line[150]], stopper_radius=5.0)
    for radius in (0, -1, np.inf):
        with pytest.raises(TracingError, match="stopper"):
            trace(volume, [line[5], line[-6]], [line[150]], stopper_radius=radius)


def test_a_vessel_within_another_one_is_refused(scene):
    line, volume = scene
    with pytest.raises(TracingError, match=r"points of vessel 1: .*within earlier vessels"):
        trace(volume, [[line[5], line[-6]], [line[60], line[150]]])


def test_a_tracer_can_go_on_after_an_error(scene):
    line, volume = scene
    tracer = Tracer(volume)
    with pytest.raises(TracingError, match="none"):
        _ = tracer.tree
    tracer.add(line[5])
    tracer.add(line[-6] + [0, 0, 12])
    with pytest.raises(TracingError):
        _ = tracer.tree
    tracer.move(1, line[-6])
    assert len(tracer.tree) == 1
    for wrong in (
        lambda: tracer.move(7, line[5]),
        lambda: tracer.remove(0, 3),
        lambda: tracer.add(line[5], 9),
    ):
        with pytest.raises(TracingError, match="whole number"):
            wrong()
    with pytest.raises(TracingError, match="nothing: there is none yet"):
        tracer.remove_stopper(0)
    with pytest.raises(TracingError, match="1 vessel"):
        tracer.route(names=["a", "b"])


def test_voxels_that_are_no_numbers_are_no_lumen():
    line = arc(60)
    made = Scene(room(line, 0.8), (0.8,) * 3)
    made.paint(line, 2.5, LUMEN)
    plain = made.volume(1)
    values = plain.array.astype(np.float32)
    values[:, :, : values.shape[2] // 4] = np.nan
    values[:2] = np.inf
    volume = Volume(values, world_from_index=plain.world_from_index)
    with pytest.raises(TracingError):
        trace(volume, [line[5], line[-6]])
    inside = [n for n in range(len(line)) if np.isfinite(volume.sample(line[n : n + 1])[0])]
    (vessel,) = trace(volume, [line[inside[40]], line[inside[-20]]])
    assert np.isfinite(vessel.points).all()
    with pytest.raises(VolumeError):
        trace(np.zeros((4, 4)), [line[5], line[-6]])


@pytest.mark.skipif(not hasattr(signal, "pthread_kill"), reason="no signals between threads here")
@pytest.mark.usefixtures("interruptible")
def test_ctrl_c_ends_the_tracing():
    volume = Volume(np.full((260, 260, 260), 300, dtype=np.int16))
    array = np.array(volume.array)
    # An endless maze of lumen, which keeps the search busy.
    array[::6] = -100
    array[:, ::40, ::40] = 300
    volume = Volume(array)
    main = threading.main_thread().ident
    timer = threading.Timer(0.1, lambda: signal.pthread_kill(main, signal.SIGINT))
    timer.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            _trace_for_ever(volume)
    finally:
        timer.cancel()


def _trace_for_ever(volume):
    while True:
        try:
            trace(volume, [[3, 3, 3], [255, 255, 255]])
        except TracingError:
            continue
