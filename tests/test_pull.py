"""``lumencut pull`` with a PACS that fails on purpose: complete files or none; no other host is asked."""

import os
import shutil
import subprocess
import sys

import pytest

from lumencut import read_volume
from lumencut.dicom.web import pulling
from lumencut.errors import PacsError
from pacs_scenes import files, forget_user, holding, run, write_scan
from pacs_stub import BOUNDARY, Pacs, running


@pytest.fixture(scope="module")
def scan(tmp_path_factory):
    return write_scan(tmp_path_factory.mktemp("ct"))


@pytest.fixture(autouse=True)
def nobody_known(monkeypatch, tmp_path):
    forget_user(monkeypatch, tmp_path)


@pytest.fixture
def pacs(scan):
    with holding(scan) as one:
        yield one


def test_a_series_is_pulled_whole_and_only_once(pacs, scan, tmp_path):
    out = tmp_path / "out"
    first = run("pull", pacs.address, "-o", out)
    assert first.exit_code == 0, first.output
    assert "24 of 24 instances fetched" in first.output
    assert {path.read_bytes() for path in files(out)} == {path.read_bytes() for path in files(scan)}
    assert {path.suffix for path in files(out)} == {".dcm"}
    assert all(headers["Accept-Encoding"] == "identity" for headers in pacs.headers)
    again = run("pull", f"dicomweb:{pacs.base}/studies/{pacs.study}", "-o", out)
    assert again.exit_code == 0, again.output
    assert "24 existed before" in again.output
    assert set(pacs.asked.values()) == {1}


def test_a_study_of_two_patients_is_said(pacs, tmp_path):
    def two(handler, path):
        if path != "/studies":
            return False
        found = [handler.described((pacs.study,)) for _ in range(2)]
        found[1]["00100020"] = {"vr": "LO", "Value": ["B-2"]}
        handler.send_json(200, found)
        return True

    assert "two patients" not in run("pull", pacs.address, "-o", tmp_path / "one").output
    pacs.fault = two
    done = run("pull", pacs.address, "-o", tmp_path / "out")
    assert done.exit_code == 0, done.output
    assert "two patients, PatientID 'phantom' and PatientID 'B-2'" in done.output


def test_studies_and_series_are_listed_with_their_addresses(pacs):
    listed = run("pull", pacs.base, "--patient", "Ph*", "--modality", "CT")
    assert listed.exit_code == 0, listed.output
    assert "Phantom^Vessel" in listed.output
    assert f"dicomweb:{pacs.base}/studies/{pacs.study}" in listed.output
    series = run("pull", f"{pacs.base}/studies/{pacs.study}")
    assert f"dicomweb:{pacs.address}" in series.output
    wrong = run("pull", f"{pacs.base}/studies/{pacs.study}", "--date", "20260101")
    assert wrong.exit_code == 2


def kept_back(pacs, uids, how):
    """Let a PACS fail for some instances."""

    def fault(handler, path):
        uid = path.rpartition("/")[2]
        if "/instances/" not in path or uid not in uids:
            return False
        content = next(value for key, value in pacs.held.items() if key[2] == uid)
        pacs.asked[uid] += 1
        {
            "partial": lambda: handler.send_instance(content, 206),
            "dies": lambda: handler.die(content),
            "cut": lambda: handler.send(
                200, b"--x\r\n\r\n" + content[:5000], "multipart/related; boundary=x"
            ),
            "other": lambda: handler.send_instance(next(iter(pacs.held.values()))),
            "text": lambda: handler.send(200, b"<html>no</html>", "text/html"),
            "error": lambda: handler.send(500, b""),
            "empty": lambda: handler.send(200, b"", "multipart/related; boundary=x"),
        }[how]()
        return True

    pacs.fault = fault


@pytest.mark.parametrize(
    ("how", "words"),
    [
        ("partial", "status 206: only a part of the request"),
        ("dies", "an interrupted connection"),
        ("cut", "an end within a part"),
        ("other", "another instance"),
        ("text", "no DICOM file"),
        ("error", "status 500"),
        ("empty", "an end within a part"),
    ],
)
def test_what_is_not_whole_is_not_there_and_is_fetched_later(pacs, scan, tmp_path, how, words):
    out, uids = tmp_path / "out", [key[2] for key in list(pacs.held)[5:8]]
    kept_back(pacs, uids, how)
    first = run("pull", pacs.address, "-o", out)
    assert first.exit_code == 3, first.output
    assert f"3 × {words}" in first.output
    assert len(files(out)) == 21
    assert {path.suffix for path in files(out)} == {".dcm"}
    with pytest.raises(PacsError, match="3 of 24 instances missing"):
        read_volume(f"dicomweb:{pacs.address}")
    pacs.fault = lambda handler, path: False
    pacs.asked.clear()
    second = run("pull", pacs.address, "-o", out)
    assert second.exit_code == 0, second.output
    assert dict(pacs.asked) == dict.fromkeys(uids, 1)
    assert {path.read_bytes() for path in files(out)} == {path.read_bytes() for path in files(scan)}


def test_a_series_of_which_much_is_missing_comes_as_one_stream(pacs, scan, tmp_path, monkeypatch):
    monkeypatch.setattr(pulling, "STREAMED", 10)
    done = run("pull", pacs.address, "-o", tmp_path / "out")
    assert done.exit_code == 0, done.output
    assert "24 of 24 instances fetched" in done.output
    assert {path.read_bytes() for path in files(tmp_path / "out")} == {
        path.read_bytes() for path in files(scan)
    }
    assert (pacs.streamed, len(pacs.asked)) == (1, 0)
    for path in files(tmp_path / "out")[3:9]:
        path.unlink()
    assert run("pull", pacs.address, "-o", tmp_path / "out").exit_code == 0
    assert (pacs.streamed, len(pacs.asked)) == (1, 6)


@pytest.mark.parametrize("how", ["dies", "partial", "none", "other"])
def test_what_a_stream_does_not_bring_is_asked_for_one_by_one(pacs, scan, tmp_path, monkeypatch, how):
    monkeypatch.setattr(pulling, "STREAMED", 10)
    contents = list(pacs.held.values())

    def fault(handler, path):
        if not path.endswith(pacs.series):
            return False
        if how == "dies":
            handler.die(b"".join(content + f"\r\n--{BOUNDARY}\r\n\r\n".encode() for content in contents))
        elif how == "other":
            handler.send_instances([contents[0], contents[0], b"no DICOM", *contents[1:9]])
        else:
            handler.send(206 if how == "partial" else 406, b"")
        return True

    pacs.fault = fault
    done = run("pull", pacs.address, "-o", tmp_path / "out")
    assert done.exit_code == 0, done.output
    assert {path.read_bytes() for path in files(tmp_path / "out")} == {
        path.read_bytes() for path in files(scan)
    }
    assert {path.suffix for path in files(tmp_path / "out")} == {".dcm"}
    expected = {"dies": range(8, 16), "partial": [24], "none": [24], "other": [15]}
    assert len(pacs.asked) in expected[how]


def test_a_pacs_that_is_gone_is_not_asked_for_everything(pacs, tmp_path):
    kept_back(pacs, {key[2] for key in pacs.held}, "error")
    result = run("pull", pacs.address, "-o", tmp_path / "out")
    assert result.exit_code == 3
    assert "not requested after" in result.output
    assert not files(tmp_path / "out")


@pytest.mark.skipif(os.name != "posix" or os.geteuid() != 0, reason="only root can mount a small disk")
def test_a_full_disk_is_named_and_leaves_no_half_file(pacs, tmp_path):
    """Uses a separate mount namespace, so that nothing remains of it."""
    code = "import sys; from lumencut.cli import main; main(sys.argv[1:])"
    script = f"mount -t tmpfs -o size=48k none {tmp_path} || exit 99; {sys.executable} -c '{code}' pull "
    script += f"{pacs.address} -o {tmp_path}/out; code=$?; find {tmp_path} -type f; exit $code"
    done = subprocess.run(["unshare", "-m", "sh", "-c", script], capture_output=True, text=True, timeout=60)
    if done.returncode == 99 or "unshare:" in done.stderr:
        pytest.skip("no name space of mounts here")
    assert done.returncode == 3, done.stderr
    assert "No space left on device" in done.stderr
    assert ".part" not in done.stdout
    assert 0 < done.stdout.count(".dcm\n") < 24


@pytest.mark.parametrize("way", ["environment", "file", "netrc", "option"])
def test_credentials_come_from_environment_file_or_netrc(pacs, tmp_path, monkeypatch, way):
    pacs.tokens = {"s3cret-token"}
    more, place = [], tmp_path / "token"
    place.write_text("s3cret-token\n")
    if way == "environment":
        monkeypatch.setenv("LUMENCUT_DICOMWEB_TOKEN", "s3cret-token")
    elif way == "file":
        monkeypatch.setenv("LUMENCUT_DICOMWEB_TOKEN_FILE", str(place))
    elif way == "option":
        more = ["--token-file", place]
    else:
        (tmp_path / "netrc").write_text("machine 127.0.0.1 login me password s3cret\n")
        monkeypatch.setenv("NETRC", str(tmp_path / "netrc"))
        pacs.tokens = {"Basic bWU6czNjcmV0"}
    result = run("pull", pacs.address, "-o", tmp_path / "out", *more)
    assert result.exit_code == 0, result.output


def test_wrong_and_missing_tokens_are_told_apart_and_never_shown(pacs, tmp_path, monkeypatch, caplog):
    pacs.tokens = {"right"}
    none = run("pull", pacs.address, "-o", tmp_path / "out", "--verbose")
    assert none.exit_code == 1
    assert "status 401: no credentials" in none.output
    assert "LUMENCUT_DICOMWEB_TOKEN" in none.output
    monkeypatch.setenv("LUMENCUT_DICOMWEB_TOKEN", "wr0ng-one")
    wrong = run("pull", pacs.address, "-o", tmp_path / "out", "--verbose")
    assert "rejected, wrong or expired" in wrong.output
    assert "wr0ng" not in wrong.output + caplog.text


def test_a_token_that_expires_is_read_anew(pacs, tmp_path):
    place = tmp_path / "token"
    place.write_text("first")
    pacs.tokens = {"first"}

    def expire(handler, path):
        if "/instances/" in path and len(pacs.asked) == 5 and pacs.tokens == {"first"}:
            place.write_text("second")
            pacs.tokens = {"second"}
        return False

    pacs.fault = expire
    result = run("pull", pacs.address, "-o", tmp_path / "out", "--token-file", place)
    assert result.exit_code == 0, result.output
    pacs.tokens = {"third"}
    shutil.rmtree(tmp_path / "out")
    refused = run("pull", pacs.address, "-o", tmp_path / "out", "--token-file", place)
    assert refused.exit_code == 1
    assert "wrong or expired" in refused.output


def test_no_redirect_leads_to_another_host(pacs, tmp_path, monkeypatch):
    monkeypatch.setenv("LUMENCUT_DICOMWEB_TOKEN", "s3cret")
    with running(Pacs()) as other:

        def lead(handler, path):
            target = f"{other.base}{path}" if path.startswith("/studies") else ""
            handler.send(302, b"", Location=target)
            return True

        pacs.fault = lead
        result = run("pull", pacs.address, "-o", tmp_path / "out")
        assert result.exit_code == 1
        assert "a redirect to http://127.0.0.1" in result.output
        assert not other.headers


def test_redirects_within_a_host_are_followed_with_the_token(pacs, tmp_path, monkeypatch):
    monkeypatch.setenv("LUMENCUT_DICOMWEB_TOKEN", "s3cret")
    pacs.tokens = {"s3cret"}

    def lead(handler, path):
        if path.startswith("/old/"):
            handler.send(307, b"", Location=handler.path.replace("/old/", "/web/", 1))
        return path.startswith("/old/")

    pacs.fault = lead
    result = run("pull", pacs.address.replace("/web/", "/old/"), "-o", tmp_path / "out")
    assert result.exit_code == 0, result.output

    def circle(handler, path):
        handler.send(302, b"", Location=handler.path)
        return True

    pacs.fault = circle
    result = run("pull", pacs.address, "-o", tmp_path / "circle")
    assert result.exit_code == 1
    assert "more than 5 redirects" in result.output


def certificate(folder):
    """A certificate for 127.0.0.1 of an unknown authority, and its key."""
    paths = folder / "cert.pem", folder / "key.pem"
    subprocess.run(
        [
            *(
                "openssl",
                "req",
                "-x509",
                "-newkey",
                "ec",
                "-pkeyopt",
                "ec_paramgen_curve:prime256v1",
                "-nodes",
            ),
            *("-days", "2", "-subj", "/CN=127.0.0.1", "-addext", "subjectAltName=IP:127.0.0.1"),
            *("-out", paths[0], "-keyout", paths[1]),
        ],
        check=True,
        capture_output=True,
    )
    return paths


def test_tls_is_verified_and_a_private_authority_is_named(scan, tmp_path):
    mine = certificate(tmp_path)
    with running(Pacs(), mine) as pacs:
        study, series = pacs.add(scan)
        address = f"{pacs.base}/studies/{study}/series/{series}"
        refused = run("pull", address, "-o", tmp_path / "out")
        assert refused.exit_code == 1
        assert "an untrusted certificate" in refused.output
        assert "--ca FILE" in refused.output
        taken = run("pull", address, "-o", tmp_path / "out", "--ca", mine[0])
        assert taken.exit_code == 0, taken.output
        none = run("pull", address, "-o", tmp_path / "out", "--ca", mine[1])
        assert "a file of certificates (PEM)" in none.output
