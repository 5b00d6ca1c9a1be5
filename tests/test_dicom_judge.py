"""The bench that judges DICOM readers: it must notice every kind of error in a volume, and nothing else."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

sys.path.append(str(Path(__file__).resolve().parents[1] / "benches"))

import dicom_readers
from dicom_judge import CANNOT, REFUSED, RIGHT, WARNED, WRONG, Verdict, judged
from dicom_peers import Answer

from dicom_phantom import axial, field, images, tilted
from dicom_series import Case, Made

PLACE = Path("nowhere")
READ = Case("read", "one", lambda folder: MADE)
REFUSE = Case("refuse", "one", lambda folder: MADE, ("no",))
MADE = Made(PLACE, images(axial()))
AFFINE, VOXELS = MADE.truth


def verdict(voxels, affine, case=READ, made=MADE, **said):
    return judged(case, made, Answer([(voxels, affine)], **said))


def test_right():
    assert verdict(VOXELS, AFFINE) == Verdict(RIGHT)
    mirrored = AFFINE @ np.diag([1.0, -1, 1, 1])
    mirrored[:3, 3] = (AFFINE @ [0, 47, 0, 1])[:3]
    assert verdict(VOXELS[:, ::-1], mirrored) == Verdict(RIGHT)
    assert verdict(VOXELS.astype(float) + 1e-4, AFFINE) == Verdict(RIGHT)


def test_nothing():
    answer = Answer(errors=["no"])
    assert judged(READ, MADE, answer) == Verdict(CANNOT)
    assert judged(REFUSE, MADE, answer) == Verdict(REFUSED)
    assert verdict(VOXELS[:2], AFFINE) == Verdict(CANNOT)


def test_places():
    moved = AFFINE.copy()
    moved[0, 3] += 0.06
    assert verdict(VOXELS, moved) == Verdict(WRONG, "up to 0.06 mm off")
    assert verdict(VOXELS, moved, warnings=["odd"]) == Verdict(WARNED, "up to 0.06 mm off")
    leaning = Made(PLACE, images(tilted(18)))
    affine, voxels = leaning.truth
    upright = affine.copy()
    upright[:3, 2] = 2 * np.cross(affine[:3, 0], affine[:3, 1]) / 0.64
    assert verdict(voxels, affine, made=leaning) == Verdict(RIGHT)
    assert verdict(voxels, upright, made=leaning) == Verdict(WRONG, "up to 14 mm off")


def test_slices():
    assert verdict(VOXELS[:-1], AFFINE) == Verdict(WRONG, "1 slice lost")
    order = [*range(23), 22]
    assert verdict(VOXELS[order], AFFINE).words == "1 slice twice"
    assert verdict(np.where(VOXELS > 200, 0, VOXELS), AFFINE) == Verdict(WRONG, "wrong values")
    assert verdict(1000 - VOXELS, AFFINE) == Verdict(WRONG, "values inverted")
    assert verdict(np.where(VOXELS > 200, np.nan, VOXELS), AFFINE).kind == WRONG
    halves = Answer([(VOXELS[:12], AFFINE), (VOXELS[12:], AFFINE @ translated(0, 0, 12))])
    assert judged(READ, MADE, halves) == Verdict(CANNOT, "2 volumes, one of each file")


def translated(*index):
    affine = np.eye(4)
    affine[:3, 3] = index
    return affine


def test_phases():
    late = [replace(one, part="late") for one in images(axial(), contrast=120.0)]
    both = Made(PLACE, [*MADE.images, *late], None)
    other = np.stack([one.values for one in late])
    apart = Answer([(VOXELS, AFFINE), (other, AFFINE)])
    assert judged(REFUSE, both, apart) == Verdict(RIGHT, "each stack on its own")
    mixed = np.where(np.arange(24)[:, None, None] % 2, VOXELS, other)
    assert verdict(mixed, AFFINE, REFUSE, both) == Verdict(WRONG, "late and only mixed")


@pytest.mark.parametrize(("shift", "expected"), [(0.0, RIGHT), (9.0, WRONG)])
def test_resampled(shift, expected):
    affine = axial((60, 40, 40), (0.7, 0.7, 1.1))
    k, j, i = np.indices((40, 40, 60))
    world = np.stack([i, j, k], -1) @ affine[:3, :3].T + affine[:3, 3]
    found = verdict(field(world + np.array([0, 0, shift])), affine)
    assert found.kind == expected
    assert found.words == ("" if expected == RIGHT else "resampled, but moved by 9 mm")


def test_cells():
    right, wrong = Verdict(RIGHT), Verdict(WRONG, "up to 3 mm off")
    assert dicom_readers.cell([right, right]) == "right"
    assert dicom_readers.cell([wrong, right, wrong]) == "1 right, 2 **WRONG, silently** (up to 3 mm off)"


def test_the_document_has_the_table():
    document = (dicom_readers.ROOT / "docs/clinic.md").read_text("utf-8")
    written = dicom_readers.column(dicom_readers.between(document)[1])
    groups = dict.fromkeys(case.group for case in dicom_readers.CASES)
    assert [name.split(" (")[0] for name in written] == list(groups)
    assert dicom_readers.WRONG not in "".join(written.values()), "Lumencut must not read wrongly unsaid"
