"""Features that docs/limits.md and docs/comparison.md call missing are missing; claimed ones exist."""

import inspect
import re
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from pydicom.encaps import encapsulate

import lumencut
from dicom_phantom import instance
from dicom_phantom import save as save_instance
from lumencut.base.file_kinds import extensions
from lumencut.cli import main
from lumencut.errors import FormatError
from volume_samples import coded, oblique, write_stack

ROOT = Path(__file__).resolve().parent.parent
LIMITS, COMPARISON = ((ROOT / "docs" / name).read_text("utf-8") for name in ("limits.md", "comparison.md"))
NAMES = {name.lower() for name in [*lumencut.__all__, *main.commands]}
AXIAL = oblique()
MISSING_HEADING = "## What Lumencut does not have\n"


def source(path: str) -> str:
    return (ROOT / path).read_text("utf-8")


def no_name_is_about(pattern):
    """Check that no command, public name or option is about the words."""
    options = {name for one in main.commands.values() for part in one.params for name in part.opts}
    return [name for name in NAMES | options if re.search(pattern, name)] == []


def rejects_stack(folder, **changes):
    def change(_, data):
        for keyword, value in changes.items():
            setattr(data, keyword, value)

    with pytest.raises(FormatError):
        lumencut.read_volume(write_stack(folder, coded(), AXIAL, change))


def rejects_syntax(folder, uid):
    """Check that a transfer syntax is rejected; its UID is put into files of a video directly."""
    video = "1.2.840.10008.1.2.4.102"

    def change(_, data):
        data.file_meta.TransferSyntaxUID = video
        data.PixelData = encapsulate([b"\0" * 16])

    for path in write_stack(folder, coded(), AXIAL, change).iterdir():
        path.write_bytes(path.read_bytes().replace(video.encode(), uid.encode()))
    with pytest.raises(FormatError):
        lumencut.read_volume(folder)


def other_dicom_is_rejected(tmp_path):
    rejects_stack(tmp_path / "colour", SamplesPerPixel=3, PhotometricInterpretation="RGB")
    rejects_stack(tmp_path / "plain", ImagePositionPatient=None)
    rejects_syntax(tmp_path / "xl", "1.2.840.10008.1.2.4.110")
    rejects_syntax(tmp_path / "video", "1.2.840.10008.1.2.4.102")


def contours_are_rejected(tmp_path):
    path = save_instance(instance(1, 30, "1.2.840.10008.5.1.4.1.1.481.3", "RTSTRUCT"), tmp_path / "rt.dcm")
    said = CliRunner().invoke(main, ["trace", "--mask", str(path), "-o", str(tmp_path / "a.vtp")])
    assert said.exit_code
    assert "RT Structure Set" in said.stderr


def the_page_chooses_no_segments(_):
    _, call, request = source("web/src/edit/segmentation.ts").partition("await made(")
    assert call
    assert "segments" not in request[:400]


def the_page_needs_its_server(_):
    assert "await made('mask'" in source("web/src/edit/segmentation.ts")
    assert "make/mask" in source("python/lumencut/viewer/posts.py")


def no_meshes_are_written(tmp_path):
    line = lumencut.Vessel(np.array([[0.0, 0, 0], [0, 0, 9]]), radius=np.array([2.0, 2.0]))
    for ending in ("stl", "ply", "obj", "vtu"):
        with pytest.raises(lumencut.LumencutError):
            lumencut.write_centerlines(lumencut.VesselTree([line]), tmp_path / f"a.{ending}")
    assert no_name_is_about(r"mesh")


def no_classic_network(_):
    for address in ("dicom://pacs.example:104", "pacs.example:104", "AE@pacs.example:104"):
        said = CliRunner().invoke(main, ["pull", address])
        assert said.exit_code
        assert "https://" in said.stderr
    assert no_name_is_about(r"c[-_]?(store|find|move|echo)$")
    assert "pynetdicom" not in source("pyproject.toml")


def the_page_asks_its_own_server_alone(_):
    assert '"connect-src": "\'self\'"' in source("python/lumencut/viewer/guard.py")
    assert "dicomweb" not in source("web/src/core/server.ts")


def values_are_no_option_of_reformations(_):
    assert "values" in inspect.signature(lumencut.Frame.save).parameters
    assert "values" not in inspect.signature(lumencut.Reformation.save).parameters
    assert {"--values"} <= {name for part in main.commands["render"].params for name in part.opts}


def cameras_are_orthographic(_):
    assert no_name_is_about("perspective")
    assert not [name for name in inspect.signature(lumencut.Camera).parameters if "perspective" in name]


def auto_takes_no_software(_):
    if all(one.is_software for one in lumencut.devices()):
        volume = lumencut.Volume(np.zeros((4, 4, 4), np.int16))
        assert "cpu" in str(lumencut.Renderer(volume, device="auto").device)


def places_are_marked_by_a_reader(_):
    at = inspect.signature(lumencut.Profile.stenosis).parameters["at"]
    assert at.default is inspect.Parameter.empty


def plaque_has_no_score(_):
    assert no_name_is_about(r"agatston|plaque|score|vulnerab")
    assert lumencut.Profile.diameter_calcium_excluded
    assert lumencut.Profile.diameter_calcium_included


#: Features that the pages call missing, by their first words, and how to check each.
MISSING = {
    "The projection is orthographic": cameras_are_orthographic,
    '`device="auto"` does not use a software GPU': auto_takes_no_software,
    "Suggested places are not findings": places_are_marked_by_a_reader,
    "Lumencut does not score or classify plaque": plaque_has_no_score,
    "DICOM must be one regular stack": other_dicom_is_rejected,
    "Contours (RT Structure Set) are rejected": contours_are_rejected,
    "In a segmentation (SEG), overlapping segments": the_page_chooses_no_segments,
    "The viewer reads a SEG through its server": the_page_needs_its_server,
    "A vessel tree has no surface": no_meshes_are_written,
    "The classic DICOM network protocol (C-STORE": no_classic_network,
    "The viewer does not connect to a PACS itself": the_page_asks_its_own_server_alone,
    "Lumencut writes values as DICOM for the cut": values_are_no_option_of_reformations,
    "segmentation of organs": lambda _: no_name_is_about(r"organ|segment(?!s$)"),
    "registration of images": lambda _: no_name_is_about(r"regist|align"),
    "flow, pressure or FFR": lambda _: no_name_is_about(r"(?<!over)flow|pressure|ffr"),
    "surface meshes of vessels": no_meshes_are_written,
    "plaque scoring or typing": plaque_has_no_score,
    "the classic DICOM network protocol": no_classic_network,
    "stenosis grading without a reader": places_are_marked_by_a_reader,
}
#: Statements that no program can check.
UNCHECKED = (
    "approval for diagnosis",
    "DICOMweb was tested with",
    "pydicom, dcmtk and dicom3tools read",
    "Few viewers show structured reports",
)


def bullets(text: str) -> list[str]:
    return re.findall(r"^\* (.*)$", text, re.MULTILINE)


@pytest.mark.parametrize("words", MISSING)
def test_what_is_called_missing_is_missing(words, tmp_path):
    assert words in LIMITS + COMPARISON
    assert MISSING[words](tmp_path) in (None, True)


def test_every_missing_ability_has_its_check():
    listed = bullets(COMPARISON.partition(MISSING_HEADING)[2])
    listed += bullets(LIMITS.partition("\n## Files\n")[2])
    assert len(listed) > 15
    assert [one for one in listed if not one.startswith((*MISSING, *UNCHECKED))] == []


# What exists


def has_commands(*names):
    return lambda: set(names) <= set(main.commands)


def mask_takes_segmentations():
    told = CliRunner().invoke(main, ["trace", "--help"]).output
    return "--mask" in told and "--label" in told


def centerlines_of_others():
    known = extensions("centerlines")
    return all(ending in known for ending in (".vtp", ".mrk.json", ".fcsv", ".pth"))


#: Features that the pages claim, by some of their words, and how to check each.
CLAIMED = {
    "from a scan alone, points, a mask or files": lambda: {"find_vessels", "trace", "trace_mask"} <= NAMES,
    "CSR of all vessels at once": lambda: {"render", "untangled", "cpr", "lumen_map"} <= NAMES,
    "reads centerlines of 3D Slicer, VMTK and SimVascular": centerlines_of_others,
    "segmentations (DICOM SEG, `.seg.nrrd`, label maps) as masks": mask_takes_segmentations,
    "scans and results with a PACS over DICOMweb": has_commands("pull", "push"),
    "many scans measured in the same way": has_commands("batch", "measure", "summarize"),
    "maps the thickness of calcium": lambda: (
        '"thickness"' in source("python/lumencut/reformations/lumen_mapping.py")
    ),
    "is not supported; DICOMweb is": has_commands("pull", "push"),
}


@pytest.mark.parametrize("words", CLAIMED)
def test_what_is_claimed_exists(words):
    assert words in " ".join((LIMITS + COMPARISON).split())
    assert CLAIMED[words]()


def test_the_uncertainty_has_the_named_parts():
    from lumencut import phantom

    tube = phantom.stenosis()
    parts = set(lumencut.measure(tube.volume, tube.tree[0]).uncertainty_parts)
    assert parts == {"noise", "point_spread", "wall", "lumen_level", "surroundings"}
    assert "covers noise, point spread, wall, lumen level and surroundings" in LIMITS
