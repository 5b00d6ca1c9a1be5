"""Remedies of errors: every host words every remedy, and programs need not parse text."""

from __future__ import annotations

import logging
import pickle
import re
from pathlib import Path
from typing import get_args

import numpy as np
import pytest
from click.testing import CliRunner

from lumencut import Mend, Vessel, VesselTree, Volume, _lumencut, read_volume, trace
from lumencut.base.mends import WORDS, MendName, advised, as_option
from lumencut.cli import main
from lumencut.errors import FormatError, LumencutError, SeriesError, SpaceWarning, VesselTreeError
from lumencut.scene.placement import check_meeting, check_space
from test_dicom import AXIAL
from test_dicom_choice import phases
from test_dicom_gaps import with_holes
from test_dicom_uneven import written
from volume_samples import coded, write_stack

PAGE = Path(__file__).parents[1] / "web/src/core/mends.ts"

VALUES = {"coordinates": ("lps", "ras"), "place": ("lps", "ras"), "unit": ("cm", "dm"), "phase": ("0", "400")}
VALUES["reading"] = ("lps in cm", "ras in m")


def test_every_host_knows_the_names_of_the_crates():
    assert get_args(MendName) == tuple(WORDS) == _lumencut.MENDS
    listed = re.search(r"MEND_NAMES = \[(.*?)\]", PAGE.read_text("utf-8"), re.DOTALL)
    assert listed is not None
    assert tuple(re.findall(r"'(\w+)'", listed[1])) == _lumencut.MENDS


@pytest.mark.parametrize("name", _lumencut.MENDS)
def test_every_mend_has_words_for_python_and_for_the_command_line(name):
    mend = Mend(name, VALUES.get(name, ()))
    assert len(str(mend)) > 10
    options = mend.written(as_option)
    assert len(options) > 10
    assert not re.search(r"\w=|`|_", options)
    # Each argument of Python in the remedy has an option of the command line.
    named = re.findall(r"\w=|`\w+`|pixel_spacing|width", str(mend))
    assert len(re.findall(r"--\w", options)) >= len(named)


@pytest.mark.parametrize(
    ("name", "argument", "option"),
    [
        (
            "fill_gaps",
            "have them interpolated with fill_gaps=True",
            "have them interpolated with --fill-gaps",
        ),
        (
            "coordinates",
            'give coordinates="lps" or coordinates="ras"',
            "give --coordinates lps or --coordinates ras",
        ),
        (
            "reading",
            'give coordinates="lps" and unit="cm", or coordinates="ras" and unit="m"',
            "give --coordinates lps and --unit cm, or --coordinates ras and --unit m",
        ),
        ("series", "its number or UID as `series`", "its number or UID as --series NUMBER|UID"),
        (
            "phase",
            "give the value of the one to read as `phase`",
            "give the value of the one to read as --phase VALUE",
        ),
    ],
)
def test_words(name, argument, option):
    mend = Mend(name, VALUES.get(name, ()))
    assert (str(mend), mend.written(as_option)) == (argument, option)


def test_advice_comes_before_the_mend_and_both_are_kept():
    error = FormatError("a", "b", "c", advised("add the files", [("fill_gaps", ())]))
    assert (
        str(error) == "a: found b; expected c; add the files, or have them interpolated with fill_gaps=True"
    )
    assert (error.advice, error.mends) == ("add the files", (Mend("fill_gaps"),))
    plain = FormatError("a", "b", "c", "add the files")
    assert (plain.advice, plain.mends) == ("add the files", ())
    again = pickle.loads(pickle.dumps(error))
    assert (str(again), again.mends, again.written(as_option)) == (
        str(error), error.mends, error.written(as_option)
    )  # fmt: skip


def refusal(folder) -> LumencutError:
    with pytest.raises(LumencutError) as caught:
        read_volume(folder)
    return caught.value


def test_refusals_of_dicom_tell_what_mends_them(tmp_path):
    gaps = refusal(with_holes(tmp_path / "gaps"))
    assert (gaps.advice, gaps.mends) == ("add the missing files", (Mend("fill_gaps"),))
    uneven = refusal(written(tmp_path / "uneven", [2.0] * 3 + [3.0] * 3))
    assert uneven.mends == (Mend("resample_slices"),)
    both = refusal(written(tmp_path / "both", [4.0] * 6 + [25.0] + [3.1] * 6))
    assert both.mends == (Mend("resample_and_fill"),)
    (tmp_path / "phases").mkdir()
    phases(tmp_path / "phases", TriggerTime=["0", "400"])
    assert refusal(tmp_path / "phases").mends == (Mend("phase", ("0", "400")),)
    (tmp_path / "series").mkdir()
    for number in ("1", "2"):
        uid = {"SeriesInstanceUID": f"1.2.{number}", "SeriesNumber": number}
        write_stack(tmp_path / "series" / number, coded(), AXIAL, lambda k, data, uid=uid: vars_of(data, uid))
    several = refusal(tmp_path / "series")
    assert isinstance(several, SeriesError)
    assert several.mends == (Mend("series"),)


def vars_of(data, values):
    for name, value in values.items():
        setattr(data, name, value)


def test_a_gap_between_clicks_is_mended_by_a_bridge():
    values = np.full((20, 20, 60), -100, np.int16)
    values[7:13, 7:13, :22] = values[7:13, 7:13, 38:] = 300
    with pytest.raises(LumencutError) as caught:
        trace(Volume(values), [(2, 10, 10), (57, 10, 10)])
    assert caught.value.mends == (Mend("bridge"),)
    assert str(caught.value).endswith(
        "; add a point where the vessel continues, or ask for a bridge where it is occluded"
    )


def test_warnings_of_spaces_are_worded_for_the_command_line_too():
    volume = Volume(np.zeros((9, 9, 9), np.int16), spacing=(10, 10, 10), origin=(20, 20, 0))
    tree = VesselTree([Vessel(np.array([[-30.0, -30, 10], [-60, -60, 40]]))])
    with pytest.warns(SpaceWarning) as caught:
        check_space(tree, volume)
    warning = caught[0].message
    assert str(warning).endswith('with coordinates="ras", or "lps" where they were read as RAS')
    assert warning.written(as_option).endswith(
        "with --coordinates ras, or --coordinates lps where they were read as RAS"
    )
    with pytest.raises(VesselTreeError) as error:
        check_meeting(volume, tree)
    assert error.value.mends == (Mend("coordinates", ("ras",)),)
    assert error.value.written(as_option).endswith("inside as RAS: read them with --coordinates ras")


def test_names_of_files_are_not_taken_for_arguments(tmp_path):
    folder = with_holes(tmp_path / "fill_gaps=True as `series`")
    result = CliRunner().invoke(main, ["render", str(folder), "-o", str(tmp_path / "out.png")])
    assert str(folder) in result.stderr
    assert result.stderr.rstrip().endswith("or have them interpolated with --fill-gaps")


def test_what_is_logged_is_worded_for_the_command_line(tmp_path, caplog, monkeypatch):
    from lumencut.cli.report import reported

    said = []
    monkeypatch.setattr("lumencut.cli.report.warn", said.append)
    import click

    with click.Context(main) as ctx, reported(ctx):
        logging.getLogger("lumencut").warning("%s: %s", "a", advised("b", [("fill_gaps", ())]))
    assert said == ["a: b, or have them interpolated with --fill-gaps"]
