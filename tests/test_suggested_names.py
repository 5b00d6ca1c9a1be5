"""Suggested names of vessels: on phantoms with known names, and on real scans whose vessels are known."""

import numpy as np
import pytest

import lumencut
from conftest import needs_shared_data
from lumencut import phantom, suggest_names


def named(tree, volume=None):
    return {one.name for one in suggest_names(tree, volume) if one.name is not None}


def truth_along(made, vessel, start, end):
    """Return the names of the phantom's vessels along a part of a line (mm), by how often they occur."""
    points = np.concatenate([one.points for one in made.tree])
    names = np.concatenate([[one.name] * len(one.points) for one in made.tree])
    steps = np.linalg.norm(np.diff(vessel.points, axis=0), axis=1)
    way = np.concatenate([[0.0], np.cumsum(steps)])
    inside = vessel.points[(way >= start) & (way <= end)]
    return [str(names[np.argmin(((points - point) ** 2).sum(axis=1))]) for point in inside]


def is_of(truth, name):
    """Whether the name of a phantom's vessel, which may have a number, is the suggested one."""
    words = truth.rstrip("0123456789 ").replace("coeliac", "celiac").replace("peroneal", "fibular")
    # Lines of phantoms run on where arteries only change their names.
    runs_on = (("external iliac", "common femoral"), ("superficial femoral", "popliteal"))
    same = {words, *(words.replace(*pair) for pair in runs_on)}
    return name.lower() in same or {words, name.lower()} == {"aortic arch", "aorta"}


def check_names(make):
    """Find the vessels of a phantom, and check that no suggested name is wrong."""
    made = make(0, scale=0.5)
    tree = lumencut.find_vessels(made.volume)
    suggested = suggest_names(tree, made.volume)
    assert sum(one.name is not None for one in suggested) >= 5
    for vessel, one in zip(tree, suggested, strict=True):
        for name, start, end in one.stretches:
            truth = truth_along(made, vessel, start, end)
            # A stretch begins and ends within the lumen of its neighbours.
            share = sum(is_of(known, name) for known in truth) / len(truth)
            assert share > 0.8, (name, start, end, set(truth))
        assert not one.is_vein_or_heart


def test_found_vessels_of_an_aorta_get_no_wrong_name():
    check_names(phantom.aorta)


def test_a_suggestion_names_nothing_by_itself_and_anything_else_is_refused():
    tree = phantom.aorta(scale=0.02).tree
    bare = lumencut.VesselTree([lumencut.Vessel(vessel.points, vessel.radius) for vessel in tree])
    assert "Abdominal aorta" in named(bare)
    assert all(vessel.name is None for vessel in bare)
    assert named(lumencut.VesselTree([lumencut.Vessel(vessel.points) for vessel in tree])) == set()
    for wrong, volume in ((None, None), (list(tree), None), (tree, 7)):
        with pytest.raises(lumencut.LumencutError):
            suggest_names(wrong, volume)


@needs_shared_data
def test_the_stent_graft_has_its_aorta_iliacs_and_mesenteric_artery(shared_data):
    tree = lumencut.read_centerlines(shared_data / "stent-cta" / "centerlines.vtp", coordinates="lps")
    both = {
        f"{side} {kind} iliac artery"
        for side in ("Left", "Right")
        for kind in ("common", "internal", "external")
    }
    # The lines lead to both external and internal iliac arteries and to the superior mesenteric artery.
    assert named(tree) == both | {"Abdominal aorta", "Superior mesenteric artery"}
    assert tree.bounds[1, 2] > 200
    for vessel, one in zip(tree, suggest_names(tree), strict=True):
        if "iliac" in one.name:
            assert (vessel.points[-1, 0] > 58) == one.name.startswith("Left")


@needs_shared_data
def test_the_dissection_has_no_wrong_name_and_its_heart_is_a_group(shared_data):
    volume = lumencut.read_volume(shared_data / "dissection-cta" / "ct_cropped.nii.gz")
    tree = lumencut.find_vessels(volume)
    suggested = suggest_names(tree, volume)
    names = {one.name: n for n, one in enumerate(suggested) if one.name is not None}
    allowed = {"Aorta", "Brachiocephalic trunk", "Left common carotid artery", "Left subclavian artery"}
    assert {"Aorta", "Brachiocephalic trunk"} <= set(names) <= allowed
    assert tree[names["Brachiocephalic trunk"]].points[-1, 0] < -20, "it leads to the patient's right"
    aorta = lumencut.read_volume(shared_data / "dissection-cta" / "aorta.nii.gz")
    veins = [vessel for vessel, one in zip(tree, suggested, strict=True) if one.is_vein_or_heart]
    assert len(veins) > 50
    assert max(vessel.radius.max() for vessel in veins) > 15
    # The mask of the aorta holds none of them.
    inside = [np.mean(mask_at(aorta, vessel.points) > 0) for vessel in veins]
    assert max(inside) < 0.5


def mask_at(mask, points):
    inverse = np.linalg.inv(mask.world_from_index)
    index = np.round(points @ inverse[:3, :3].T + inverse[:3, 3]).astype(int)
    index = np.clip(index, 0, np.array(mask.array.shape[::-1]) - 1)
    return mask.array[index[:, 2], index[:, 1], index[:, 0]]
