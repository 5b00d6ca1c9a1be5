"""Every volume of the shared data: its grid and all voxels, or the right error."""

from __future__ import annotations

import nibabel
import numpy as np
import pydicom
import pytest
import SimpleITK

from lumencut.errors import FormatError
from lumencut.files.volumes import inspect_volume, read_volume
from volume_samples import DATA

pytestmark = pytest.mark.skipif(
    not DATA.is_dir(), reason="the data folder ../shared/data is not beside the repository"
)

# Size, spacing, type, range and origin (LPS), once read by SimpleITK and checked by hand.
VOLUMES = {
    "stent-cta/stent_cta.nii.gz": ((128, 128, 256), (1, 1, 1), "int16", (0, 2000), (0, 0, 0)),
    "stent-cta/stent_lumen_mask.nii.gz": ((128, 128, 256), (1, 1, 1), "uint8", (0, 1), (0, 0, 0)),
    "dissection-cta/ct_cropped.nii.gz": (
        *((120, 126, 164), (1.5, 1.5, 1.5), "int16", (-1078, 3343)),
        (-71.658, -255.658, 540.2),
    ),
    "aorta-mra/aorta.mha": (
        *((157, 393, 34), (0.878906, 0.878906, 1.50009), "float32", (0, 2570.2048)),
        (-156.445, -24.609, 0),
    ),
    "aorta-mra/aorta_lumen_mask.nii.gz": (
        *((157, 393, 34), (0.878906, 0.878906, 1.50009), "uint8", (0, 1)),
        (-156.445, -24.609, 0),
    ),
    "odd-volumes/FLAIR.nrrd": (
        *((124, 160, 140), (1, 1, 1), "uint8", (0, 255)),
        (64.898, 110.431, -27.926),
    ),
    "odd-volumes/LPS.nii.gz": (
        *((64, 79, 67), (2.38516, 2.38984, 2.36651), "float32", (0, 92.553886)),
        (-74.507, -75.638, -71.763),
    ),
    "odd-volumes/PSL.nii.gz": (
        *((79, 67, 64), (2.38984, 2.36651, 2.38516), "float32", (0, 92.553886)),
        (-74.507, -75.638, -71.763),
    ),
    "odd-volumes/RAS.nii.gz": (
        *((64, 79, 67), (2.38516, 2.38984, 2.36651), "float32", (0, 92.553886)),
        (75.763, 110.763, -71.763),
    ),
    "odd-volumes/low_res.nii.gz": ((7, 5, 3), (2, 2, 2), "uint8", (0, 1), (0, 0, 0)),
    "odd-volumes/mha.mha": (
        *((64, 64, 37), (3.4375, 3.4375, 3.8), "int16", (0, 6690)),
        (-108.281, 82.38, -47.836),
    ),
} | {
    f"dissection-cta/{name}.nii.gz": (
        *((120, 126, 164), (1.5, 1.5, 1.5), "uint8", (0, 1)),
        (-71.658, -255.658, 540.2),
    )
    for name in ("aorta", "aorta_true_lumen", "aorta_false_lumen")
}
REFUSED = {
    "odd-volumes/ct_perfusion.nii.gz": "colour voxels; expected one integer or float .*; write one channel"
}
FOLDERS = ("dicom/ct-jpeg2000", "dicom/ct-missing-slices", "dicom/ct-gantry-tilt")
# Lines and curves, which the tests of centerlines read.
ELSEWHERE = ("formats", "centerlines")
LINES = (".vtp", ".vtk", ".json", ".swc", ".csv", ".txt", ".pth")
TEXTS = ("README.md", "LICENSE")


def test_every_file_has_a_test():
    stray = []
    for path in sorted(path for path in DATA.rglob("*") if path.is_file()):
        name = path.relative_to(DATA).as_posix()
        named = name in VOLUMES or name in REFUSED or name.startswith(tuple(f"{one}/" for one in FOLDERS))
        line = name.startswith(tuple(f"{one}/" for one in ELSEWHERE)) or path.suffix in LINES
        if not (named or line or path.name in TEXTS):
            stray.append(name)
    assert not stray, "name these files in a table above"


@pytest.mark.parametrize("name", [*VOLUMES, *REFUSED, *FOLDERS])
def test_every_test_has_its_file(name):
    assert (DATA / name).exists()


@pytest.mark.parametrize("name", VOLUMES)
def test_volume(name):
    size, spacing, dtype, value_range, origin = VOLUMES[name]
    report = inspect_volume(DATA / name)
    assert (report.size, report.dtype) == (size, dtype)
    np.testing.assert_allclose(report.spacing, spacing, rtol=1e-3)
    np.testing.assert_allclose(report.value_range, value_range, rtol=1e-6)
    np.testing.assert_allclose(report.world_from_index[:3, 3], origin, atol=1e-3)


@pytest.mark.parametrize("name", VOLUMES)
def test_volume_is_the_one_that_simpleitk_reads(name):
    volume, image = read_volume(DATA / name), SimpleITK.ReadImage(str(DATA / name))
    ends = [(0, length - 1) for length in volume.size]
    for index in ((i, j, k) for i in ends[0] for j in ends[1] for k in ends[2]):
        world = volume.world_from_index @ [*index, 1.0]
        np.testing.assert_allclose(world[:3], image.TransformIndexToPhysicalPoint(index), atol=1e-3)
    voxels = SimpleITK.GetArrayFromImage(image)
    np.testing.assert_allclose(volume.array, voxels, rtol=1e-6 if volume.array.dtype.kind == "f" else 0)


@pytest.mark.parametrize("name", [name for name in VOLUMES if name.endswith(".nii.gz")])
def test_volume_is_the_one_that_nibabel_reads(name):
    volume, image = read_volume(DATA / name), nibabel.load(DATA / name)
    np.testing.assert_array_equal(volume.world_from_index, np.diag([-1, -1, 1, 1]) @ image.affine)
    np.testing.assert_allclose(volume.array.T, np.asanyarray(image.dataobj), rtol=1e-6)


@pytest.mark.parametrize("name", REFUSED)
def test_refused(name):
    for read in (read_volume, lambda path: inspect_volume(path, values=False)):
        with pytest.raises(FormatError, match=REFUSED[name]) as caught:
            read(DATA / name)
        assert name in str(caught.value)


@pytest.mark.parametrize("other", ["PSL", "RAS"])
def test_permuted_and_flipped_axes_show_one_world(other):
    """Each voxel of one file coincides in position and value with a voxel of the other."""
    one, two = (read_volume(DATA / "odd-volumes" / f"{name}.nii.gz") for name in ("LPS", other))
    index = np.moveaxis(np.indices(one.size), 0, -1).reshape(-1, 3)
    world = index @ one.world_from_index[:3, :3].T + one.origin
    found = np.linalg.solve(two.world_from_index[:3, :3], (world - two.origin).T).T
    # The grids of both files differ by at most 0.01 mm.
    np.testing.assert_allclose(found, np.rint(found), atol=0.01)
    i, j, k = np.rint(found).astype(int).T
    np.testing.assert_array_equal(one.array[tuple(index.T[::-1])], two.array[k, j, i])


def test_masks_lie_on_their_volumes():
    for mask, volume in (
        ("stent-cta/stent_lumen_mask.nii.gz", "stent-cta/stent_cta.nii.gz"),
        ("dissection-cta/aorta_true_lumen.nii.gz", "dissection-cta/ct_cropped.nii.gz"),
        ("aorta-mra/aorta_lumen_mask.nii.gz", "aorta-mra/aorta.mha"),
    ):
        inside, values = read_volume(DATA / mask), read_volume(DATA / volume)
        np.testing.assert_allclose(inside.world_from_index, values.world_from_index, atol=1e-3)
        assert values.array[inside.array > 0].mean() > 2 * np.abs(values.array[inside.array == 0].mean())


def slices_of(folder):
    """The headers of a folder's images in the order of their positions along z."""
    paths = [path for path in (DATA / folder).iterdir() if path.name not in ("DIRFILE", "LICENSE")]
    headers = [(path, pydicom.dcmread(path, stop_before_pixels=True)) for path in paths]
    return sorted(headers, key=lambda item: float(item[1].ImagePositionPatient[2]))


@pytest.mark.parametrize(("folder", "count"), [("dicom/ct-jpeg2000", 20), ("dicom/ct-gantry-tilt", 16)])
def test_dicom_folder_slice_by_slice(folder, count):
    slices, volume = slices_of(folder), read_volume(DATA / folder)
    assert len(slices) == count
    assert volume.size == (512, 512, count)
    affine = volume.world_from_index
    for k, (path, header) in enumerate(slices):
        place = affine[:3, 3] + k * affine[:3, 2]
        np.testing.assert_allclose(place, [float(v) for v in header.ImagePositionPatient], atol=1e-2)
        across = np.array(header.ImageOrientationPatient, float).reshape(2, 3).T * header.PixelSpacing[0]
        np.testing.assert_allclose(affine[:3, :2], across, atol=1e-5)
        expected = SimpleITK.GetArrayFromImage(SimpleITK.ReadImage(str(path)))[0]
        np.testing.assert_array_equal(volume.array[k], expected)


def test_dicom_refusal_and_notes():
    with pytest.raises(FormatError, match=r"3 missing slices: 1 between .*4 mm.*, 2 between .*6 mm"):
        read_volume(DATA / "dicom" / "ct-missing-slices")
    assert len(slices_of("dicom/ct-missing-slices")) == 17
    notes = " ".join(inspect_volume(DATA / "dicom" / "ct-gantry-tilt", values=False).notes)
    assert "DIRFILE" in notes
    assert "16.50 degrees" in notes
