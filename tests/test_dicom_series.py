"""All kinds of DICOM series that we know: each is read exactly, or rejected with the right reason."""

from __future__ import annotations

import logging
import re

import numpy as np
import pydicom
import pytest

from dicom_cases import CASES
from dicom_repeated import REPEATED
from lumencut import FormatError, VolumeError, read_volume
from lumencut.files.volumes import as_volume


@pytest.mark.usefixtures("one_decoder")
@pytest.mark.parametrize("case", [*CASES, *REPEATED], ids=lambda case: case.name)
def test_series(tmp_path, caplog, case):
    if case.needs:
        pytest.importorskip(case.needs)
    made = case.write(tmp_path)
    caplog.set_level(logging.WARNING, "lumencut")
    if case.words:
        with pytest.raises(FormatError) as caught:
            read_volume(made.path, series=case.series, phase=case.phase)
        for word in case.words:
            assert re.search(word, str(caught.value)), str(caught.value)
        assert_datasets_in_memory_are_refused(made, case)
        return
    wanted = {"series": case.series, "phase": case.phase, "resample_slices": case.resample_slices}
    volume = read_volume(made.path, **wanted)
    affine, voxels = made.truth
    np.testing.assert_allclose(volume.world_from_index, affine, atol=1e-5)
    assert volume.array.shape == voxels.shape
    exact = voxels.dtype.kind == "i" and not case.loss
    np.testing.assert_allclose(volume.array, voxels, rtol=0 if exact else 1e-6, atol=case.loss)
    for word in case.notes:
        assert word in caplog.text
    if case.resample_slices:
        assert_datasets_in_memory_are_refused(made, case)
    elif datasets := datasets_of(made, case):
        in_memory = as_volume(datasets)
        np.testing.assert_array_equal(in_memory.world_from_index, volume.world_from_index)
        assert in_memory.array.dtype == volume.array.dtype
        np.testing.assert_array_equal(in_memory.array, volume.array)


def assert_datasets_in_memory_are_refused(made, case):
    if datasets := datasets_of(made, case):
        with pytest.raises(VolumeError):
            as_volume(datasets)


def datasets_of(made, case):
    """Return the datasets of a folder of one series; none if pydicom cannot read a file either."""
    if not made.path.is_dir() or case.series is not None or case.phase is not None:
        return []
    try:
        return [pydicom.dcmread(path) for path in sorted(made.path.rglob("*")) if path.is_file()]
    except Exception:
        return []
