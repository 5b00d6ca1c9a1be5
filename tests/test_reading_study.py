"""The reading study: what readers see is balanced and blinded, and its statistics are right."""

import json
import re
from collections import Counter

import numpy as np
import pytest
from click.testing import CliRunner

import lumencut
from lumencut import Camera, FileError, FormatError, Renderer, VesselTree, VesselTreeError
from lumencut.cli import main
from lumencut.evaluation.reading_study import make_study, study_results
from lumencut.evaluation.reading_study.marked_places import pairs
from lumencut.evaluation.reading_study.questions import METHODS, TASKS, questions_of
from lumencut.evaluation.reading_study.statistics import Counts, agreement, holm, interval, sign_test
from lumencut.files.volume_writers import write_volume
from reading_study_scene import PLACES, two_tubes

READERS = 12


@pytest.fixture(scope="module")
def scene():
    return two_tubes()


@pytest.fixture(scope="module")
def study(scene, tmp_path_factory):
    folder = tmp_path_factory.mktemp("study")
    page, key = make_study(Renderer(*scene), folder, readers=READERS, seed=4, size=(160, 160))
    return page, json.loads(key.read_text("utf-8")), key


def made_up(folder, key, choose, readers=range(1, READERS + 1), **changed):
    """Files of made-up answers; `choose` returns the choice of a reader for a question of the key."""
    files = []
    for reader in readers:
        answers = [
            {"question": name, "choice": choose(reader, one), "seconds": 2.5}
            for name, one in key["readers"][str(reader)].items()
        ]
        content = {"format": "lumencut-reading-answers", "version": 1, "study": key["study"]}
        path = folder / f"answers-{reader:02d}.json"
        path.write_text(json.dumps({**content, "reader": reader, "answers": answers, **changed}))
        files.append(path)
    return files


def always(method):
    """Readers who prefer a method, answer every task right and find everything useful."""
    return lambda _, one: one.get("right", one["methods"].index(method) if len(one["methods"]) > 1 else 0)


def row_of(results, criterion, answer):
    return next(row for row in results.table if (row["criterion"], row["answer"]) == (criterion, answer))


def test_every_reader_answers_21_questions_of_the_five_criteria():
    counts = Counter(one.criterion for one in questions_of(3, 0))
    assert counts == {
        "vessel lumen": 4,
        "surrounding tissue": 4 + 1,
        "visibility": 4 + 1,
        "depth perception": 3,
        "silhouettes": 3 + 1,
    }


def test_places_of_methods_and_methods_of_tasks_are_balanced_over_readers():
    places, tasks = Counter(), Counter()
    for reader in range(1, READERS + 1):
        for one in questions_of(reader, 0):
            if one.criterion in TASKS and one.pictures:
                tasks[one.name, one.pictures[0].method] += 1
            for place, picture in enumerate(one.pictures if len(one.pictures) > 1 else ()):
                places[one.name, place, picture.method] += 1
    assert set(places.values()) == {READERS // len(METHODS)}
    assert {count for (name, _), count in tasks.items() if "depth" in name} == {READERS // 3}
    assert {count for (name, _), count in tasks.items() if "silhouettes" in name} == {READERS // 2}


def test_readers_see_another_order_and_a_seed_repeats_it():
    orders = [[one.name for one in questions_of(reader, 1)] for reader in (1, 2)]
    assert orders[0] != orders[1]
    assert orders[0] == [one.name for one in questions_of(1, 1)]
    assert orders[0] != [one.name for one in questions_of(1, 2)]


def test_the_page_names_no_method_and_contacts_no_server(study):
    page = study[0].read_text("utf-8")
    words = re.sub(r"data:image/png;base64,[A-Za-z0-9+/=]*", "", page).lower()
    for method in ("csr", "cpr", "reformation", "curved", "http:", "https:"):
        assert method not in words
    assert "default-src 'none'" in page
    assert page.count("data:image/png") == len(study[1]["pictures"]) == 4 * 4 + 3 * (3 + 2)


def test_the_closer_place_lies_on_the_vessel_in_front(scene):
    volume, tree = scene
    camera = Camera.anterior(tree, (160, 160))
    frames = [lumencut.render(volume, tree, camera), lumencut.mpcpr(volume, tree, camera)]
    found = pairs(tree, camera, frames, 12, np.random.default_rng(2))
    assert {pair.closer for pair in found} == {0, 1}
    for pair in found:
        vessels = [frames[0].vessel[round(row), round(column)] for column, row in pair.pixels]
        # The viewer is in front of the patient, at small y.
        assert vessels[pair.closer] == min(vessels, key=lambda vessel: PLACES[vessel][1])
        assert vessels[0] != vessels[1]


def test_a_study_never_replaces_another(scene, study):
    with pytest.raises(FileError, match=r"expected a new folder"):
        make_study(Renderer(*scene), study[0].parent)


def test_one_vessel_has_no_depths_to_compare(scene, tmp_path):
    volume, tree = scene
    with pytest.raises(VesselTreeError, match="give more vessels"):
        make_study(Renderer(volume, VesselTree([tree[0]])), tmp_path, size=(160, 160))
    assert list(tmp_path.iterdir()) == []


def test_readers_of_one_mind_give_all_their_votes_to_the_method(study, tmp_path):
    results = study_results(study[2], made_up(tmp_path, study[1], always("cr")))
    assert (results.readers, results.invited) == (READERS, READERS)
    for criterion in ("vessel lumen", "surrounding tissue", "visibility"):
        row = row_of(results, criterion, "cr")
        assert (row["count"], row["of"], row["percent"]) == (48, 48, 100.0)
        assert (row["low"], row["high"]) == (100.0, 100.0)
        # All twelve readers differ in the same direction; the smallest of three tests counts threefold.
        assert row["p_against_csr"] == pytest.approx(3 * 2 / 2**READERS)
        assert row_of(results, criterion, "cpr")["p_against_csr"] == 1.0
    assert row_of(results, "depth perception", "right with mpcpr")["percent"] == 100.0
    assert row_of(results, "usefulness of silhouettes", "Yes")["count"] == READERS
    assert row_of(results, "visibility", "csr")["median_s"] == 2.5
    assert "12 of 12 readers" in results.to_markdown()


def test_random_readers_have_no_preference(study, tmp_path):
    draw = np.random.default_rng(5)
    files = made_up(tmp_path, study[1], lambda _, one: int(draw.integers(len(one["choices"]))))
    results = study_results(study[2], files)
    tested = [row["p_against_csr"] for row in results.table if row["p_against_csr"] is not None]
    assert min(tested) > 0.05
    for criterion in ("vessel lumen", "surrounding tissue", "visibility"):
        assert abs(row_of(results, criterion, "csr")["agreement"]) < 0.15


@pytest.mark.parametrize(
    ("changed", "found"),
    [
        ({"study": "other"}, "another study"),
        ({"reader": 99}, "reader 99"),
        ({"answers": []}, "0 answers"),
        ({"answers": 5}, "5"),
        ({"format": "x"}, "format 'x'"),
        ({"version": 2}, "version 2"),
    ],
)
def test_answers_that_do_not_fit_are_rejected(study, tmp_path, changed, found):
    with pytest.raises(FormatError, match=found):
        study_results(study[2], made_up(tmp_path, study[1], always("csr"), [1], **changed))


@pytest.mark.parametrize(("choice", "found"), [(5, "choice 5"), (True, "choice True"), (-1, "choice -1")])
def test_a_choice_that_does_not_exist_is_rejected(study, tmp_path, choice, found):
    with pytest.raises(FormatError, match=found):
        study_results(study[2], made_up(tmp_path, study[1], lambda *_: choice, [1]))


def test_a_reader_counts_once(study, tmp_path):
    files = made_up(tmp_path, study[1], always("csr"), [2])
    with pytest.raises(FormatError, match="reader 2 a second time"):
        study_results(study[2], files * 2)


def test_the_sign_test_is_exact():
    def counts(*chosen):
        return Counts("x", np.array(chosen), np.full(len(chosen), 4))

    assert sign_test(counts(4, 3, 2, 1, 1, 1), counts(0, 0, 0, 0, 0, 0)) == 2 / 2**6
    assert sign_test(counts(1, 0), counts(0, 1)) == 1.0
    assert sign_test(counts(2, 2), counts(2, 2)) == 1.0
    # Shares are compared: one of two is more than one of three.
    assert (
        sign_test(Counts("x", np.ones(6), np.full(6, 2)), Counts("y", np.ones(6), np.full(6, 3))) == 2 / 2**6
    )


def test_holms_correction():
    assert holm([0.01, 0.04, 0.03]) == pytest.approx([0.03, 0.06, 0.06])
    assert holm([0.9, 0.8]) == [1.0, 1.0]


def test_fleiss_kappa_of_a_published_table():
    """Ten subjects rated by fourteen raters; kappa is 0.210 (Fleiss, Levin and Paik, 2003)."""
    votes = np.array(
        [
            [0, 0, 0, 0, 14],
            [0, 2, 6, 4, 2],
            [0, 0, 3, 5, 6],
            [0, 3, 9, 2, 0],
            [2, 2, 8, 1, 1],
            [7, 7, 0, 0, 0],
            [3, 2, 6, 3, 0],
            [2, 5, 3, 2, 2],
            [6, 5, 2, 1, 0],
            [0, 2, 2, 3, 7],
        ]
    )
    assert agreement(votes) == pytest.approx(0.210, abs=0.0005)
    assert agreement(np.array([[3, 0], [3, 0]])) is None


def test_the_interval_holds_the_share_and_narrows_with_readers():
    few, many = (Counts("x", np.tile([0, 4], n), np.full(2 * n, 4)) for n in (4, 100))
    for counts in (few, many):
        low, high = interval(counts)
        assert low < 50 < high
    assert interval(many)[1] - interval(many)[0] == pytest.approx(2 * 1.96 * 100 * 0.5 / 200**0.5, rel=0.1)
    assert interval(Counts("x", np.array([1]), np.array([2]))) == (None, None)


def test_the_commands_make_a_study_and_compare_its_answers(scene, tmp_path):
    volume, tree = scene
    scan, lines, out = tmp_path / "scan.nii.gz", tmp_path / "lines.vtp", tmp_path / "study"
    write_volume(volume, scan)
    lumencut.write_centerlines(tree, lines)
    words = ["reading-study", str(scan), str(lines), "-o", str(out), "--readers", "3", "--size", "160x160"]
    made = CliRunner().invoke(main, words)
    assert made.exit_code == 0, made.output
    key = json.loads((out / "key.json").read_text("utf-8"))
    assert list(key["readers"]) == ["1", "2", "3"]
    files = made_up(tmp_path, key, always("csr"), [1, 3])
    compared = CliRunner().invoke(main, ["reading-results", str(out / "key.json"), *map(str, files)])
    assert compared.exit_code == 0, compared.output
    assert "2 of 3 readers" in compared.output
    table = tmp_path / "table.csv"
    words = ["reading-results", str(out / "key.json"), *map(str, files), "--csv", str(table)]
    assert CliRunner().invoke(main, words).exit_code == 0
    assert table.read_text("utf-8").startswith("criterion,answer,count,of,percent")
    assert lumencut.__version__ in (out / "reading-study.html").read_text("utf-8")
