"""``lumencut pull`` and addresses of a PACS in place of files, against a PACS that fails on purpose."""

import os
import shutil
import subprocess
import sys

import numpy as np
import pydicom
import pytest
from click.testing import CliRunner

from dicom_phantom import save, single
from dicom_series import PLAIN_STACK
from lumencut import list_series, read_volume
from lumencut.cli import main
from lumencut.dicomweb import pulling
from lumencut.dicomweb.address import parsed_address
from lumencut.dicomweb.source import fetched
from lumencut.errors import FormatError, LumencutError, PacsError
from lumencut.viewer import page as page_room
from lumencut.viewer.server import ViewerServer
from pacs_stub import BOUNDARY, Pacs, running
from segmentation_files import segmentation
from view_serving import Client, split, write_page


@pytest.fixture(scope="module")
def scan(tmp_path_factory):
    """A CT of 24 slices."""
    folder = tmp_path_factory.mktemp("ct")
    for k, image in enumerate(PLAIN_STACK):
        save(single(image, k + 1), folder / f"IM{k:03}.dcm")
    return folder


@pytest.fixture(autouse=True)
def nobody_known(monkeypatch, tmp_path):
    """No credentials of whoever runs the tests."""
    for name in ("TOKEN", "TOKEN_FILE", "CA"):
        monkeypatch.delenv(f"LUMENCUT_DICOMWEB_{name}", raising=False)
    monkeypatch.setenv("NETRC", str(tmp_path / "no-netrc"))


@pytest.fixture
def pacs(scan):
    with running(Pacs()) as running_one:
        running_one.study, running_one.series = running_one.add(scan)
        running_one.address = f"{running_one.base}/studies/{running_one.study}/series/{running_one.series}"
        yield running_one


def run(*arguments):
    return CliRunner().invoke(main, [*map(str, arguments)])


def files(folder):
    return sorted(path for path in folder.rglob("*") if path.is_file())


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
    assert "24 were there" in again.output
    assert set(pacs.asked.values()) == {1}


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
        ("partial", "status 206: a part of what was asked for"),
        ("dies", "a connection that broke off"),
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
    assert "not asked for any more" in result.output
    assert not files(tmp_path / "out")


@pytest.mark.skipif(os.name != "posix" or os.geteuid() != 0, reason="only root can mount a small disk")
def test_a_full_disk_is_named_and_leaves_no_half_file(pacs, tmp_path):
    """In a name space of mounts of its own, so that nothing stays of it."""
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
    assert "refused, wrong or expired" in wrong.output
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
    """A certificate of nobody known for 127.0.0.1, and its key."""
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
        assert "a certificate that is not trusted" in refused.output
        assert "--ca FILE" in refused.output
        taken = run("pull", address, "-o", tmp_path / "out", "--ca", mine[0])
        assert taken.exit_code == 0, taken.output
        none = run("pull", address, "-o", tmp_path / "out", "--ca", mine[1])
        assert "a file of certificates (PEM)" in none.output


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ("http://pacs.example/dicom-web", "which anybody on the way can read"),
        ("https://me:pw1@pacs.example/web", "a name or a password"),
        ("https://pacs.example/web?token=1", "dicomweb:https://HOST"),
        ("https://pacs.example/web/studies/..%2f1", "dicomweb:https://HOST"),
        ("https://pacs.example/studies/1/series/2/instances/3", "dicomweb:https://HOST"),
        ("ftp://pacs.example", "dicomweb:https://HOST"),
        ("https://[::1", "dicomweb:https://HOST"),
    ],
)
def test_addresses_that_are_none_are_refused(given, words):
    with pytest.raises(FormatError, match="address") as caught:
        parsed_address(given)
    assert words in str(caught.value)
    assert "pw1" not in str(caught.value)


def test_a_path_keeps_the_address():
    from pathlib import Path

    given = "dicomweb:https://pacs.example/dicom-web/studies/1.2/series/3.4"
    assert parsed_address(Path(given)) == parsed_address(given)
    assert str(parsed_address(Path(given))) == given


def test_an_address_stands_where_a_volume_stands(pacs, scan, tmp_path):
    given = f"dicomweb:{pacs.address}"
    seen = []
    volume = read_volume(given, progress=lambda done, total: seen.append((done, total)))
    np.testing.assert_array_equal(volume.array, read_volume(scan).array)
    assert (24, 24) in seen
    folder = fetched(given).path
    assert not folder.exists()
    save(segmentation({1: volume_mask(volume)}, {1: "vessel"}), tmp_path / "seg.dcm")
    pacs.take((tmp_path / "seg.dcm").read_bytes())
    study = f"dicomweb:{pacs.base}/studies/{pacs.study}"
    told = run("info", study)
    assert told.exit_code == 0, told.output
    assert "value range  -33, 372" in told.output
    table = tmp_path / "studies.csv"
    table.write_text(f"id,volume,mask\np1,{study},seg.dcm\n")
    done = run("batch", table, "-o", tmp_path / "out", "--jobs", "1")
    assert done.exit_code == 0, done.output
    missing = run("info", f"dicomweb:{pacs.base}/studies/1.2.3")
    assert missing.exit_code == 1
    assert "no such study" in missing.output


def volume_mask(volume):
    from lumencut import Volume

    return Volume((volume.array > 200).astype(np.uint8), world_from_index=volume.world_from_index)


def test_the_viewer_serves_what_it_fetched_from_this_machine_alone(pacs, scan, tmp_path, monkeypatch):
    monkeypatch.setattr(page_room, "FOLDER", write_page(tmp_path / "page"))
    bodies = []

    def ask(server):
        bodies.append(Client(server).ask("data/volume").body)

    monkeypatch.setattr(ViewerServer, "wait", ask)
    shown = run("view", f"dicomweb:{pacs.address}", "--no-browser")
    assert shown.exit_code == 0, shown.output
    header, voxels = split(bodies[0])
    assert header["size"] == [64, 48, 24]
    assert voxels == read_volume(scan).array.astype(np.int16).tobytes()


def test_a_study_of_several_series_is_listed_and_chosen_from(pacs, scan, tmp_path):
    for path in sorted(scan.iterdir()):
        data = pydicom.dcmread(path)
        data.SeriesInstanceUID += ".9"
        data.SOPInstanceUID += ".9"
        data.file_meta.MediaStorageSOPInstanceUID = data.SOPInstanceUID
        data.SeriesNumber = 9
        save(data, tmp_path / path.name)
    pacs.add(tmp_path)
    study = f"dicomweb:{pacs.base}/studies/{pacs.study}"
    several = run("info", study)
    assert several.exit_code == 0, several.output
    assert "--series" in several.output
    pacs.asked.clear()
    assert read_volume(study, series=9).size == (64, 48, 24)
    assert all(uid.endswith(".9") for uid in pacs.asked)
    assert len(pacs.asked) == 24
    assert len(list_series(study)) == 2


def test_a_server_that_is_not_there_is_named(tmp_path):
    with running(Pacs()) as pacs:
        base = pacs.base
    with pytest.raises(LumencutError, match="no connection"):
        read_volume(f"dicomweb:{base}/studies/1.2.3")
