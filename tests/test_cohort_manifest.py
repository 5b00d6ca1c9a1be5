"""Manifests and recipes of cohorts: what is read; an error lists all mistakes."""

from __future__ import annotations

import numpy as np
import pytest

import lumencut
from cohort_scenes import RECIPE, run, run_here, table, write_cohort, write_greedy
from lumencut.cohort.checking import trouble_of, verdict_of
from lumencut.cohort.manifest import Study, read_manifest
from lumencut.cohort.recipe import CohortRecipe, Reading, read_cohort_recipe
from lumencut.cohort.sources import scan_of
from lumencut.errors import FileError, FormatError
from scene_files import bent_line, write_lines, write_volume
from test_dicom import AXIAL
from volume_samples import coded, write_stack


def manifest_of(folder, text, name="studies.csv"):
    path = folder / name
    path.write_bytes(text if isinstance(text, bytes) else text.encode("utf-8"))
    return path


def test_relative_paths_are_read_from_the_folder_of_the_table(tmp_path):
    text = "id,volume,mask,label,age\np1,ct/p1.nii.gz,seg/p1.nii.gz,52=aorta,61\np2,/far/p2.nii.gz,,,70\n"
    manifest = read_manifest(manifest_of(tmp_path, text))
    first, second = manifest.studies
    assert first.volume == tmp_path / "ct/p1.nii.gz"
    assert (first.source, first.given) == ("mask", str(tmp_path / "seg/p1.nii.gz"))
    assert first.reading == {"label": "52=aorta"}
    assert (second.source, str(second.volume)) == ("none", "/far/p2.nii.gz")
    assert manifest.further == ("age",)
    assert [one.further for one in manifest.studies] == [("61",), ("70",)]


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("t.tsv", "id\tvolume\na\tx,y.nii\n"),
        ("t.csv", "id;volume\na;x,y.nii\n"),
        ("t.csv", '﻿id,volume\r\na,"x,y.nii"\r\n\r\n'),
        ("t.csv", "id\tvolume\na\tx,y.nii\n"),
    ],
)
def test_separators_and_marks_of_spreadsheets(tmp_path, name, text):
    (study,) = read_manifest(manifest_of(tmp_path, text, name)).studies
    assert (study.id, study.volume.name) == ("a", "x,y.nii")


@pytest.mark.parametrize(
    ("study_id", "label", "folder"),
    [
        ("p1", "sub-p1", "sub-p1"),
        ("sub-p1", "sub-p1", "sub-p1"),
        ("case_01-b", "sub-case01b", "sub-case01b"),
        ("sub-p1_ses-2", "sub-p1_ses-2", "sub-p1/ses-2"),
    ],
)
def test_names_are_those_of_bids(tmp_path, study_id, label, folder):
    (study,) = read_manifest(manifest_of(tmp_path, f"id,volume\n{study_id},a.nii\n")).studies
    assert (study.label, str(study.folder)) == (label, folder)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("id,volume\na,1.nii\na,2.nii\n", "line 3: the id 'a', which line 2 has"),
        ("id,volume\na-1,1.nii\nA1,2.nii\n", "line 3: the id 'A1' like 'a-1'"),
        ("id,volume\n../a,1.nii\n", "line 2: the id '../a'"),
        ("id,volume\na.b,1.nii\nc/d,2.nii\n", "line 3: the id 'c/d'"),
        ("id,volume\n,1.nii\n", "line 2: the id ''"),
        ("id,volume\na,\n", "line 2: no volume"),
        ("id,volume,mask,seeds\na,1.nii,m.nii,\"1,2,3\"\n", "line 2: mask and seeds, of which one"),
        ("id,volume,label\na,1.nii,52\n", "line 2: a label without a mask"),
        ("id,volume,fwhm\na,1.nii,wide\n", "line 2: the fwhm 'wide'"),
        ("id,scan\na,1.nii\n", "found the columns id, scan; expected also volume"),
        ("name,volum\na,1.nii\n", "perhaps 'volume' is meant"),
        ("id,volume\na,1.nii,3\n", "found 3 fields in line 2; expected 2"),
        ("id,volume,id\na,1.nii,b\n", "the column 'id' twice"),
        ("id,,volume\na,x,1.nii\n", "no name of column 2"),
        ("id,volume\n", "no study"),
        ("", "an empty file"),
        (b"id,volume\nM\xfcller,1.nii\n", "the byte 0xfc in line 2, which is not UTF-8"),
        (b"id,volume\na,1\x00.nii\n", "a null character in line 2"),
        ('id,volume\na,"1.nii\n', "line 2"),
    ],
)  # fmt: skip
def test_mistakes_are_named_with_their_line(tmp_path, text, words):
    with pytest.raises(FormatError) as error:
        read_manifest(manifest_of(tmp_path, text))
    assert words in str(error.value)


def test_all_mistakes_are_named_at_once(tmp_path):
    text = "id,volume\na,1.nii\na,2.nii\nb/c,3.nii\n"
    with pytest.raises(FormatError) as error:
        read_manifest(manifest_of(tmp_path, text))
    assert "line 3" in str(error.value)
    assert "line 4" in str(error.value)


def test_names_one_letter_off_are_warned_of(tmp_path):
    manifest = read_manifest(manifest_of(tmp_path, "id,volume,centerline,Mask,masc,age\na,1.nii,,,,5\n"))
    assert manifest.further == ("centerline", "Mask", "masc", "age")
    assert len(manifest.notes) == 3
    assert "'centerline' is only copied; perhaps 'centerlines' is meant" in manifest.notes[0]


def test_a_pattern_names_volumes_and_masks(tmp_path):
    for name in ("b2", "a1"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "ct.nii.gz").touch()
    (tmp_path / "c3").mkdir()
    manifest = read_manifest(f"{tmp_path}/{{id}}/ct.nii.gz", mask=f"{tmp_path}/masks/{{id}}.nii.gz")
    assert [one.id for one in manifest.studies] == ["a1", "b2"]
    assert manifest.studies[0].given == str(tmp_path / "masks/a1.nii.gz")
    with pytest.raises(FormatError, match="no such file"):
        read_manifest(f"{tmp_path}/none-{{id}}.nii.gz")
    with pytest.raises(FormatError, match="in place of the id"):
        read_manifest(f"{tmp_path}/{{id}}/ct.nii.gz", mask="mask.nii.gz")


def test_a_missing_manifest_is_named(tmp_path):
    with pytest.raises(FileError, match=r"none\.csv"):
        read_manifest(tmp_path / "none.csv")


def test_the_check_names_each_study_that_will_fail(tmp_path):
    write_volume(tmp_path / "ct.nii.gz")
    write_lines(tmp_path / "lines.vtk")
    (tmp_path / "broken.nii").write_bytes(b"no volume")
    (tmp_path / "broken.vtk").write_text("# vtk DataFile Version 3.0\n", "utf-8")
    inside = ",".join(f"{x:g}" for x in bent_line()[4])
    rows = {
        "good": "ct.nii.gz,lines.vtk,,,",
        "found": "ct.nii.gz,,,,",
        "seeded": f'ct.nii.gz,,,"{inside}",',
        "gone": "gone.nii.gz,,,,",
        "broken": "broken.nii,,,,",
        "lines": "ct.nii.gz,broken.vtk,,,",
        "nolines": "ct.nii.gz,none.vtk,,,",
        "mask": "ct.nii.gz,,broken.nii,,",
        "beside": 'ct.nii.gz,,,"500,0,0",',
        "single": f'ct.nii.gz,,,,"{inside}"',
        "words": 'ct.nii.gz,,,"1,2",',
    }
    text = "id,volume,centerlines,mask,seeds,points\n" + "".join(f"{k},{v}\n" for k, v in rows.items())
    manifest = read_manifest(manifest_of(tmp_path, text))
    troubles = {one.id: trouble_of(one, Reading()) for one in manifest.studies}
    assert [name for name, trouble in troubles.items() if not trouble] == ["good", "found", "seeded"]
    assert "no such file" in troubles["gone"]
    assert "500, 0, 0 (mm, LPS), outside of the volume" in troubles["beside"]
    assert "expected two or more along the vessel" in troubles["single"]
    assert "three numbers x,y,z" in troubles["words"]


def test_a_mask_of_another_grid_is_found_by_its_header(tmp_path):
    import nibabel as nib

    path = write_volume(tmp_path / "ct.nii.gz")
    image = nib.load(path)
    flipped = np.asarray(image.dataobj)[::-1]
    turned = image.affine @ np.array([[-1, 0, 0, 23], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
    nib.save(nib.Nifti1Image((flipped > 100).astype(np.uint8), turned), tmp_path / "same.nii.gz")
    moved = image.affine.copy()
    moved[0, 3] += 0.5
    nib.save(nib.Nifti1Image((flipped > 100).astype(np.uint8), moved), tmp_path / "other.nii.gz")
    text = "id,volume,mask\na,ct.nii.gz,same.nii.gz\nb,ct.nii.gz,other.nii.gz\n"
    first, second = (trouble_of(one, Reading()) for one in read_manifest(manifest_of(tmp_path, text)).studies)
    assert first == ""
    assert "expected the same grid" in second


def test_three_hundred_rows_are_checked(tmp_path):
    write_volume(tmp_path / "ct.nii.gz")
    write_lines(tmp_path / "lines.vtk")
    rows = [f"p{n},ct.nii.gz,lines.vtk\n" for n in range(300)]
    path = manifest_of(tmp_path, "id,volume,centerlines\n" + "".join(rows))
    manifest = read_manifest(path)
    assert [trouble_of(study, Reading()) for study in manifest.studies] == [""] * 300


def test_the_command_checks_and_does_nothing(tmp_path):
    manifest = write_cohort(tmp_path, good=7)
    words = ("batch", str(manifest), "--check")
    ended = run_here(*words)
    assert ended.returncode == 3
    assert ended.stdout.splitlines()[-1].startswith("12 studies, 1 will fail, of ")
    assert "missing: " in ended.stdout
    assert not (tmp_path / "out").exists()
    manifest.write_text("id,volume\na,1.nii\na,2.nii\n", "utf-8")
    refused = run_here(*words)
    assert refused.returncode == 2
    assert "which line 2 has" in refused.stderr


def test_the_recipe_says_whether_missing_slices_are_filled(tmp_path):
    folder = tmp_path / "ct"
    write_stack(folder, coded((4, 3, 8)), AXIAL, lambda k, data: None)
    (folder / "IM0003.dcm").unlink()
    study = Study("a", folder)
    assert "1 missing slice" in trouble_of(study, Reading())
    how = recipe_of(tmp_path, "[reading]\nfill_gaps = true\n").reading
    assert trouble_of(study, how) == ""
    assert scan_of(study, how).filled_slices == (3,)


def recipe_of(folder, text):
    path = folder / "recipe.toml"
    path.write_text(text, "utf-8")
    return read_cohort_recipe(path)


def test_a_recipe_says_what_is_done(tmp_path):
    text = """
[centerlines]
smallest_radius = 2
[pictures]
views = ["left", "anterior"]
looks = "body"
size = [200, 100]
reformations = ["straightened"]
[measure]
wall = [45, 25]
[outputs]
report = true
"""
    recipe = recipe_of(tmp_path, text)
    assert recipe.centerlines.smallest_radius == 2
    assert (recipe.pictures.views, recipe.pictures.looks) == (("left", "anterior"), ("body",))
    assert recipe.pictures.size == (200, 100)
    assert recipe.measure.wall == (45.0, 25.0)
    assert recipe.outputs.report
    assert recipe.measure.step == CohortRecipe().measure.step
    assert recipe.digest != CohortRecipe().digest
    assert recipe.digest == recipe_of(tmp_path, text).digest
    assert recipe_of(tmp_path, "") == CohortRecipe() == read_cohort_recipe(None)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("[picture]\nviews = []", "perhaps pictures is meant"),
        ("[pictures]\nview = []", "perhaps views is meant"),
        ("[measure]\nsteps = 1", "the key 'steps' in [measure]"),
        ("pictures = 3", "expected a table [pictures]"),
        ('[pictures]\nviews = ["front"]', "a list of names from: anterior"),
        ('[pictures]\nviews = ["left", "left"]', "each name once"),
        ("[pictures]\nsize = [10, 10]", "width and height in pixels"),
        ("[measure]\nstep = 0", "a number from 0.01 to 100"),
        ("[measure]\nstep = true", "a number from 0.01 to 100"),
        ('[measure]\nwall = "thick"', "level and deviation such as [45, 25]"),
        ("[outputs]\nreport = 1", "true or false"),
        ("[measure", "invalid TOML"),
    ],
)
def test_mistakes_in_a_recipe_are_named(tmp_path, text, words):
    with pytest.raises(FormatError) as error:
        recipe_of(tmp_path, text)
    assert words in str(error.value)


@pytest.mark.usefixtures("nursery")
def test_the_check_and_the_batch_agree_on_sizes_and_lines(tmp_path):
    import nibabel as nib

    plain = write_volume(tmp_path / "whole.nii").read_bytes()
    image = nib.load(tmp_path / "whole.nii")
    (tmp_path / "cut.nii").write_bytes(plain[:-100])
    write_volume(tmp_path / "packed.nii.gz")
    (tmp_path / "halved.nii.gz").write_bytes((tmp_path / "packed.nii.gz").read_bytes()[:-30])
    nib.save(nib.Nifti1Image((image.get_fdata() > 100).astype(np.uint8), image.affine), tmp_path / "mask.nii")
    (tmp_path / "short.nii").write_bytes((tmp_path / "mask.nii").read_bytes()[:-1])
    volume = lumencut.read_volume(tmp_path / "whole.nii")
    voxels = np.ascontiguousarray(volume.array, "<i2").tobytes()
    for name, count in (("whole", len(voxels)), ("cut", len(voxels) - 2)):
        (tmp_path / f"{name}.raw").write_bytes(voxels[:count])
        size = " ".join(map(str, volume.size))
        head = f"NDims = 3\nDimSize = {size}\nElementSpacing = 1 1 1\nElementType = MET_SHORT\n"
        (tmp_path / f"{name}.mhd").write_text(f"{head}ElementDataFile = {name}.raw\n", "utf-8")
        head = f"NRRD0004\ntype: short\ndimension: 3\nspace: LPS\nsizes: {size}\n"
        head += "encoding: raw\nendian: little\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n"
        head += "space origin: (0,0,0)\n"
        (tmp_path / f"{name}.nhdr").write_text(f"{head}data file: {name}.raw\n", "utf-8")
    write_lines(tmp_path / "in.vtk")
    write_lines(tmp_path / "out.vtk", bent_line() + 5000)
    rows = {
        "whole": ("whole.nii", "in.vtk", ""),
        "cut": ("cut.nii", "in.vtk", ""),
        "mhd": ("whole.mhd", "in.vtk", ""),
        "mhdcut": ("cut.mhd", "in.vtk", ""),
        "nhdr": ("whole.nhdr", "in.vtk", ""),
        "nhdrcut": ("cut.nhdr", "in.vtk", ""),
        "beside": ("whole.nii", "out.vtk", ""),
        "short": ("whole.nii", "", "short.nii"),
        "packed": ("packed.nii.gz", "in.vtk", ""),
        "halved": ("halved.nii.gz", "in.vtk", ""),
    }
    text = "id,volume,centerlines,mask\n" + "".join(f"{name},{','.join(row)}\n" for name, row in rows.items())
    manifest = manifest_of(tmp_path, text)
    verdicts = {one.id: verdict_of(one, Reading()) for one in read_manifest(manifest).studies}
    failing = {"cut", "mhdcut", "nhdrcut", "beside", "short"}
    assert {name for name, verdict in verdicts.items() if verdict.trouble} == failing
    unsure = {name: verdict.unsure[0] for name, verdict in verdicts.items() if verdict.unsure}
    packed = {name: words for name, words in unsure.items() if "whether all voxels are there" in words}
    assert set(packed) == {"packed", "halved"}
    assert "packed.nii.gz" in packed["packed"]
    (tmp_path / "recipe.toml").write_text(RECIPE, "utf-8")
    (tmp_path / "site").mkdir()
    run(manifest, tmp_path / "out")
    states = {row["id"]: row["state"] for row in table(tmp_path / "out/studies.csv")}
    assert {name for name, state in states.items() if state == "failed"} == {*failing, "halved"}


def test_slices_that_are_cut_off_are_found_by_their_sizes(tmp_path):
    folder = tmp_path / "ct"
    write_stack(folder, coded((40, 30, 8)), AXIAL, lambda k, data: None)
    study = Study("a", folder)
    assert verdict_of(study, Reading()).trouble == ""
    cut = folder / "IM0003.dcm"
    cut.write_bytes(cut.read_bytes()[:-200])
    trouble = verdict_of(study, Reading()).trouble
    assert "IM0003.dcm" in trouble
    with pytest.raises(FormatError) as raised:
        scan_of(study, Reading())
    assert str(raised.value) == trouble


def test_voxels_that_do_not_fit_into_the_memory_are_found_before(tmp_path):
    write_greedy(tmp_path / "greedy.nii")
    study = Study("a", tmp_path / "greedy.nii")
    trouble = verdict_of(study, Reading(), 4 << 30).trouble
    assert "found 4.194 GB of voxels; expected at most 4.027 GB, the memory that --memory leaves" in trouble
    verdict = verdict_of(study, Reading(), 8 << 30)
    assert verdict.trouble == ""
    assert "only measuring can show whether the memory is enough" in verdict.unsure[0]
    assert verdict_of(study, Reading(), 64 << 30).unsure == ()
