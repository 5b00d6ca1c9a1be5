"""The issue forms and the release workflow agree with the rest of the repository."""

import re
import tomllib
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).resolve().parents[1]
FORMS = ROOT / ".github/ISSUE_TEMPLATE"
WORKFLOW = (ROOT / ".github/workflows/release.yml").read_text("utf-8")


@pytest.fixture(scope="module")
def jobs():
    return yaml.safe_load(WORKFLOW)["jobs"]


@pytest.mark.parametrize("name", ["fault", "wish"])
def test_a_form_asks_and_warns_of_patients_data(name):
    text = (FORMS / f"{name}.yml").read_text("utf-8")
    form = yaml.safe_load(text)
    asked = [one for one in form["body"] if one["type"] != "markdown"]
    assert {"name", "description", "labels", "body"} == set(form)
    assert len({one["id"] for one in asked}) == len(asked) >= 3
    assert any(one.get("validations", {}).get("required") for one in asked)
    assert "Never attach data of a patient" in " ".join(text.split())


def test_a_report_of_a_fault_needs_the_words_of_the_doctor():
    form = yaml.safe_load((FORMS / "fault.yml").read_text("utf-8"))
    [doctor] = [one for one in form["body"] if one.get("id") == "doctor"]
    assert "`lumencut doctor`" in doctor["attributes"]["label"]
    assert doctor["validations"]["required"]


def test_the_release_builds_for_three_systems_and_tries_each_on_every_python(jobs):
    built = {jobs["linux"]["runs-on"], *jobs["elsewhere"]["strategy"]["matrix"]["machine"]}
    matrix = jobs["trial"]["strategy"]["matrix"]
    assert {name.partition("-")[0] for name in built} == {"ubuntu", "windows", "macos"}
    assert set(matrix["machine"]) == built
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    assert matrix["python"][0] == project["requires-python"].removeprefix(">=")
    assert matrix["python"] == ["3.11", "3.12", "3.13", "3.14"]
    kept = [step["with"]["name"] for job in ("linux", "elsewhere") for step in jobs[job]["steps"][-1:]]
    assert kept == [f"wheels-{jobs['linux']['runs-on']}", "wheels-${{ matrix.machine }}"]
    assert jobs["release"]["needs"] == "trial"


def test_the_release_takes_the_tools_that_the_repository_names():
    [maturin] = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["build-system"]["requires"]
    assert f"pip install {maturin}\n" in WORKFLOW
    assert set(re.findall(r"node-version\S*: (.*)", WORKFLOW)) == {".nvmrc"}


def test_pull_requests_run_every_check_and_the_audits_that_need_the_network():
    checks = yaml.safe_load((ROOT / ".github/workflows/checks.yml").read_text("utf-8"))
    # YAML reads the key `on` as true.
    assert set(checks[True]) == {"pull_request"}
    ran = {
        job: "\n".join(one.get("run", "") for one in steps["steps"]) for job, steps in checks["jobs"].items()
    }
    assert "make test" in ran["tests"]
    assert all(one in ran["audit"] for one in ("check advisories", "pip_audit", "npm audit"))
