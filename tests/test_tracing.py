"""Centerlines from clicks, in vessels with known centerlines."""

import numpy as np
import pytest

import lumencut
from lumencut import Tracer, Vessel, VesselTree, phantom, read_centerlines, trace, write_centerlines
from trace_scenes import (
    FAT,
    LUMEN,
    TISSUE,
    Scene,
    arc,
    away,
    leaks,
    lengths,
    random_case,
    room,
)


def painted(line, radius, *, spacing=0.6, value=LUMEN, seed=1, before=None, after=None, background=TISSUE):
    """Return a volume of one vessel; `before` and `after` paint more into the scene."""
    scene = Scene(room(line, spacing), (spacing,) * 3)
    scene.values[:] = background
    if before:
        before(scene)
    scene.paint(line, radius, value)
    if after:
        after(scene)
    return scene.volume(seed)


@pytest.fixture(scope="module")
def short():
    """A line of 60 mm, and the volume of a vessel of radius 2.5 mm along it."""
    line = arc(60)
    return line, painted(line, 2.5, background=FAT)


@pytest.mark.each_value(most=2)
@pytest.mark.parametrize("seed", [1, 5, 9, 12, 21])
def test_seeded_scenes_have_no_leak(seed):
    case = random_case(seed)
    for clicks in (case.clicks[[0, -1]], case.clicks):
        (vessel,) = trace(case.volume, clicks)
        assert not leaks(vessel.points, case), case.what


def test_a_traced_vessel_has_a_radius_and_a_confidence_at_each_point(short):
    line, volume = short
    (vessel,) = trace(volume, [line[5], line[-6]])
    assert vessel.points.shape == (len(vessel), 3)
    assert vessel.points.dtype == vessel.radius.dtype == vessel.confidence.dtype == np.float64
    assert (vessel.bridged.dtype, vessel.bridged.any()) == (np.bool_, False)
    assert away(vessel.points, line).max() < 0.25
    assert vessel.radius == pytest.approx(2.5, abs=0.2)
    assert ((vessel.confidence > 0.8) & (vessel.confidence <= 1)).all()


def test_several_vessels_join_where_they_meet():
    made = phantom.y_junction()
    ends = [vessel.points[[0, -1]] for vessel in made.tree]
    trunk, left, right = trace(made.volume, ends, names=["trunk", "left", "right"])
    assert (trunk.name, left.name, right.name) == ("trunk", "left", "right")
    for branch in (left, right):
        shared = (trunk.points == branch.points[0]).all(axis=1) | (trunk.points == branch.points[-1]).all(
            axis=1
        )
        assert shared.sum() == 1
    for vessel, truth in zip((trunk, left, right), made.tree, strict=True):
        assert away(vessel.points, truth.points).max() < 1.0


def test_a_branch_from_the_same_first_click_leaves_the_trunk_at_a_point_of_it():
    line = arc(60)
    side = line[150] + np.linspace(0, 1, 150)[:, None] * np.array([22.0, -9.0, 0.0])
    volume = painted(line, 3.0, after=lambda scene: scene.paint(side, 1.8, LUMEN))
    trunk, branch = trace(volume, [[line[5], line[-6]], [line[5], side[-8]]])
    assert (trunk.points == branch.points[0]).all(axis=1).sum() == 1
    assert np.linalg.norm(branch.points[0] - line[150]) < 2.0
    assert branch.length < 24
    assert away(branch.points, side).max() < 1.0


def test_a_tracer_follows_what_is_added_moved_and_removed(short):
    line, volume = short
    tracer = Tracer(volume)
    assert tracer.add(line[5]) == 0
    tracer.add(line[-6])
    first = tracer.tree
    assert first == trace(volume, [line[5], line[-6]])
    tracer.add(line[100], index=1)
    tracer.move(1, line[120] + [0.8, 0, 0])
    moved = tracer.tree
    assert away(moved[0].points, first[0].points).max() < 0.1
    tracer.move(0, line[60])
    assert tracer.tree[0].length == pytest.approx(lengths(line)[-6] - lengths(line)[60], abs=1.0)
    tracer.remove(1)
    tracer.move(0, line[5])
    assert away(tracer.tree[0].points, first[0].points).max() < 0.02
    assert [len(points) for points in tracer.points] == [2]
    assert tracer.add(line[30], vessel=1) == 1
    assert len(tracer.tree) == 1


def test_a_stopper_forbids_a_place():
    bend = np.linspace(0, np.pi, 200)
    way = np.stack([20 * np.cos(bend), np.zeros_like(bend), 20 * np.sin(bend)], axis=1)
    other = way * [1, 1, -1]
    volume = painted(way, 2.0, after=lambda scene: scene.paint(other, 2.5, LUMEN), spacing=0.8)
    clicks = [way[0], way[-1]]
    tracer = Tracer(volume)
    for click in clicks:
        tracer.add(click)
    # A loop of two vessels: if one is blocked, the line takes the other.
    taken = way if away(tracer.tree[0].points, way).max() < 1 else other
    stopper = tracer.stop(taken[100], radius=4.0)
    left = other if taken is way else way
    assert away(tracer.tree[0].points[10:-10], left).max() < 1
    assert trace(volume, clicks, [taken[100]], stopper_radius=4.0) == tracer.tree
    tracer.remove_stopper(stopper)
    assert away(tracer.tree[0].points[10:-10], taken).max() < 1


def test_an_occlusion_is_bridged_only_where_that_is_asked_for():
    line = arc(60)
    along = lengths(line)
    shut = np.abs(along - 30) < 6
    volume = painted(line, 2.5, value=np.where(shut, TISSUE, LUMEN))
    clicks = [line[5], line[-6]]
    with pytest.raises(lumencut.TracingError, match="do not look like lumen, least at"):
        trace(volume, clicks)
    (vessel,) = trace(volume, clicks, bridge=True)
    middle = np.abs(along[[np.argmin(((line - p) ** 2).sum(axis=1)) for p in vessel.points]] - 30)
    assert vessel.bridged[middle < 4].all()
    assert not vessel.bridged[middle > 8].any()
    assert (vessel.confidence[vessel.bridged] == 0).all()
    # The bridge is straight, but the vessel was not.
    assert away(vessel.points, line).max() < 2.0


def test_progress_ends_with_all_of_it(short):
    line, volume = short
    told = []
    trace(volume, [line[5], line[-6]], progress=lambda done, total: told.append((done, total)))
    assert told[-1][0] == told[-1][1]
    assert [done for done, _ in told] == sorted(done for done, _ in told)


@pytest.mark.parametrize("ending", ["vtp", "vtk", "csv", "mrk.json"])
def test_files_hold_radius_and_confidence(short, tmp_path, ending):
    line, volume = short
    tree = trace(volume, [line[5], line[-6]])
    path = tmp_path / f"lines.{ending}"
    write_centerlines(tree, path)
    assert "onfidence" in path.read_text()
    (again,) = read_centerlines(path, "lps")
    assert np.array_equal(again.points, tree[0].points)
    assert np.array_equal(again.radius, tree[0].radius)


def test_vessels_know_their_confidence_and_bridges():
    points = np.arange(9.0).reshape(3, 3)
    vessel = Vessel(points, 1.0, confidence=[0, 0.5, 1], bridged=[True, False, False])
    assert vessel.named("a").confidence.tolist() == [0, 0.5, 1]
    assert vessel.named("a").bridged.tolist() == [True, False, False]
    assert vessel != Vessel(points, 1.0)
    assert VesselTree([vessel]).smoothed(1.0)[0].bridged.tolist() == [True, False, False]
    for wrong in (
        {"confidence": [0, 1]},
        {"confidence": [0, 1, 2]},
        {"bridged": [1, 0, 0]},
        {"bridged": [True]},
    ):
        with pytest.raises(lumencut.VesselTreeError):
            Vessel(points, 1.0, **wrong)


def test_doubts_about_a_traced_line_are_notes_of_its_tree():
    line = arc(60)

    def faded(scene):
        # The second half of the vessel is that of a dimmer lumen.
        scene.paint(line[len(line) // 2 :], 4.0, 220.0)

    volume = painted(line, 4.0, background=FAT, after=faded)
    (note,) = trace(volume, [line[2], line[-3]], names=["aorta"]).notes
    assert note.startswith("vessel 0: Doubtful from ")
    assert "the brightness of the lumen changes there from 3" in note
