"""What Python makes of files that the page opens too: the truth for the tests of its readers.

    python samples.py FOLDER

writes the made series of ``tests/dicom_cases.py`` and ``tests/dicom_repeated.py``, and small volumes of every
other format, to the folder, reads them and the volumes of ``../shared/data`` (where they are), and writes
what came of each to ``expected.json``.
"""

from __future__ import annotations

import hashlib
import json
import logging
import math
import os
import sys
from collections.abc import Callable, Iterator
from importlib.util import find_spec
from pathlib import Path
from typing import Any, ClassVar

import nibabel
import nrrd
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
#: Larger files of the shared data are read by the long tests.
MOST_BYTES = 3_000_000
sys.path.insert(0, str(ROOT / "tests"))

from dicom_cases import CASES  # noqa: E402
from dicom_repeated import REPEATED  # noqa: E402
from dicom_scenes import scan  # noqa: E402
from lumencut import Vessel, set_threads, straightened_volume  # noqa: E402
from lumencut._lumencut import cut_off_note  # noqa: E402
from lumencut.dicom.reading import workers  # noqa: E402
from lumencut.errors import LumencutError  # noqa: E402
from lumencut.files.volumes import inspected_volume, read_volume  # noqa: E402
from volume_samples import DATA, coded, oblique  # noqa: E402

Writer = Callable[[Path], Path]


class SharedDecoder(workers.Worker):
    """The decoder of all series is one process, since its start takes longer than decoding a series."""

    _of_all: ClassVar[dict[str, Any]] = {}

    def __init__(self) -> None:
        if not self._of_all:
            super().__init__()
            self._of_all.update(self.__dict__)
        self.__dict__ = self._of_all

    def kill(self) -> None:
        """Keep the process for the next series."""

    def close(self) -> None:
        """Keep the process for the next series."""

    def end(self) -> None:
        """End the process."""
        super().close()


def read(path: Path, **wanted: Any) -> dict[str, Any]:
    """What reading gives: a volume, or the words of a refusal."""
    try:
        report, volume = inspected_volume(path, **wanted)
    except LumencutError as error:
        series = [one.uid for one in getattr(error, "series", ())]
        mends = [{"name": mend.name, "values": mend.values} for mend in error.mends]
        words = {"found": error.found, "expected": error.expected, "mend": error.advice}
        return {**words, "mends": mends, "series": series}
    voxels = np.ascontiguousarray(volume.array, np.float32)
    # The page gets this note from the engine, not from the reader.
    of_values = cut_off_note(volume)
    return {
        "size": list(volume.size),
        "affine": volume.world_from_index.tolist(),
        "dtype": volume.array.dtype.name,
        "sha256": hashlib.sha256(voxels.tobytes()).hexdigest(),
        "notes": [note for note in report.notes if note != of_values],
        "states": {"spacing": volume.states_spacing, "orientation": volume.states_orientation},
    }


def nifti(image: Callable[..., Any] = nibabel.Nifti1Image, name: str = "v.nii", **header: Any) -> Writer:
    """A NIfTI file with these fields in its header."""

    def write(folder: Path) -> Path:
        made = image(coded().T, np.diag([-1, -1, 1, 1]) @ oblique())
        nibabel.save(made, folder / name)
        if header:
            _stated(folder / name, header)
        return folder / name

    return write


def _stated(path: Path, header: dict[str, Any]) -> None:
    """Put fields into a file that nibabel would write otherwise."""
    data = bytearray(path.read_bytes())
    for field, value in header.items():
        place, kind = {
            "slope": (112, "<f4"),
            "inter": (116, "<f4"),
            "sform_code": (254, "<i2"),
            "qform_code": (252, "<i2"),
            "xyzt_units": (123, "u1"),
            "datatype": (70, "<i2"),
        }[field]
        data[place : place + np.dtype(kind).itemsize] = np.array(value, kind).tobytes()
    path.write_bytes(data)


def big_endian(folder: Path) -> Path:
    """A NIfTI file with the highest byte first."""
    header = nibabel.Nifti1Header(endianness=">")
    header.set_data_dtype(">i2")
    nibabel.save(nibabel.Nifti1Image(coded().T, oblique(), header), folder / "v.nii")
    return folder / "v.nii"


def nrrd_of(name: str = "v.nrrd", dtype: str = "i2", **header: Any) -> Writer:
    """An NRRD file."""

    def write(folder: Path) -> Path:
        affine = oblique()
        placed = {"space": "RAS", "space directions": affine[:3, :3].T, "space origin": affine[:3, 3]}
        stated = placed | header
        nrrd.write(str(folder / name), coded(dtype=dtype).T, stated, detached_header=name.endswith("nhdr"))
        return folder / name

    return write


def metaimage(name: str, data: str = "LOCAL", dtype: str = "i2", **fields: Any) -> Writer:
    """A MetaImage."""

    def write(folder: Path) -> Path:
        voxels = coded(dtype=dtype).tobytes()
        kind = {"i2": "MET_SHORT", ">i2": "MET_SHORT", "f8": "MET_DOUBLE", "u4": "MET_UINT"}[dtype]
        stated = {
            "ObjectType": "Image",
            "NDims": 3,
            "BinaryDataByteOrderMSB": dtype.startswith(">"),
            "TransformMatrix": "0.8 0.6 0 -0.6 0.8 0 0 0.1 1",
            "Offset": "-3 4.5 7",
            "ElementSpacing": "0.5 0.75 2",
            "DimSize": "4 3 5",
            "ElementType": kind,
            **fields,
            "ElementDataFile": data,
        }
        if stated.get("CompressedData"):
            import zlib

            voxels = zlib.compress(voxels)
        text = "".join(f"{key} = {value}\n" for key, value in stated.items() if value is not None).encode()
        if data == "LOCAL":
            text += voxels
        else:
            (folder / data).write_bytes(voxels)
        (folder / name).write_bytes(text)
        return folder / name

    return write


def cut(writer: Writer, keep: float) -> Writer:
    """The first part of a file."""

    def write(folder: Path) -> Path:
        path = writer(folder)
        data = path.read_bytes()
        path.write_bytes(data[: int(len(data) * keep)])
        return path

    return write


def flipped(writer: Writer, at: float) -> Writer:
    """A file with one byte changed."""

    def write(folder: Path) -> Path:
        path = writer(folder)
        data = bytearray(path.read_bytes())
        data[int(len(data) * at)] ^= 0xFF
        path.write_bytes(data)
        return path

    return write


def twice_gzipped(folder: Path) -> Path:
    """A NIfTI file in two gzip streams, one behind the other, with more behind them."""
    import gzip

    whole = nifti()(folder).read_bytes()
    path = folder / "w.nii.gz"
    path.write_bytes(gzip.compress(whole[:400]) + gzip.compress(whole[400:]) + b"more")
    return path


def marked(image: Callable[..., Any]) -> Writer:
    """A NIfTI file that says what a straightened vessel says of its sides."""

    def write(folder: Path) -> Path:
        made = image(coded().T, np.diag([-1, -1, 1, 1]) @ oblique())
        made.header["descrip"] = MARK.encode()
        made.header.set_xyzt_units("mm")
        nibabel.save(made, folder / "v.nii")
        return folder / "v.nii"

    return write


#: Of a vessel that runs across the body.
MARK = "Lumencut straightened vessel; sides SPL at its middle; up to 88.5 deg off"
GZIPPED = nifti(name="v.nii.gz")
VOLUMES: dict[str, Writer] = {
    "NIfTI": nifti(),
    "NIfTI gzipped": GZIPPED,
    "NIfTI in two streams": twice_gzipped,
    "NIfTI pair": nifti(nibabel.Nifti1Pair, "v.hdr"),
    "NIfTI-2": nifti(nibabel.Nifti2Image),
    "NIfTI big-endian": big_endian,
    "NIfTI by qform": nifti(sform_code=0, qform_code=1),
    "NIfTI without placement": nifti(sform_code=0, qform_code=0),
    "NIfTI in metres": nifti(xyzt_units=1),
    "NIfTI in no unit": nifti(xyzt_units=0),
    "NIfTI of an odd code": nifti(sform_code=77),
    "NIfTI whole slope": nifti(slope=3.0, inter=-1024.0),
    "NIfTI wide slope": nifti(slope=500.0, inter=0.0),
    "NIfTI fractional slope": nifti(slope=0.1, inter=5.0),
    "NIfTI slope 0": nifti(slope=0.0, inter=5.0),
    "NIfTI complex": nifti(datatype=32),
    "NIfTI unknown type": nifti(datatype=99),
    "NIfTI of a straightened vessel": marked(nibabel.Nifti1Image),
    "NIfTI-2 of a straightened vessel": marked(nibabel.Nifti2Image),
    "NIfTI cut": cut(nifti(), 0.9),
    "NIfTI header cut": cut(nifti(), 0.3),
    "NIfTI gzipped and cut": cut(GZIPPED, 0.8),
    "NIfTI gzipped and damaged": flipped(GZIPPED, 0.7),
    "NIfTI gzipped, wrong check sum": flipped(GZIPPED, 0.985),
    "NRRD": nrrd_of(encoding="raw"),
    "NRRD gzip": nrrd_of(encoding="gzip"),
    "NRRD ascii": nrrd_of(encoding="ascii"),
    "NRRD detached": nrrd_of("v.nhdr", encoding="raw"),
    "NRRD LAS floats": nrrd_of(dtype="f4", encoding="gzip", space="LAS"),
    "NRRD in cm": nrrd_of(encoding="raw", **{"space units": ["cm", "cm", "cm"]}),
    "NRRD of a straightened vessel": nrrd_of(encoding="raw", content=MARK),
    "NRRD cut": cut(nrrd_of(encoding="raw"), 0.9),
    "NRRD gzip cut": cut(nrrd_of(encoding="gzip"), 0.9),
    "MetaImage": metaimage("v.mha"),
    "MetaImage big-endian": metaimage("v.mha", dtype=">i2"),
    "MetaImage doubles": metaimage("v.mha", dtype="f8"),
    "MetaImage of 32 bits": metaimage("v.mha", dtype="u4"),
    "MetaImage compressed": metaimage("v.mha", CompressedData=True),
    "MetaImage detached": metaimage("v.mhd", "v.raw"),
    "MetaImage with a label": metaimage("v.mha", AnatomicalOrientation="LPS"),
    "MetaImage without spacing": metaimage("v.mha", ElementSpacing=None),
    "MetaImage of colours": metaimage("v.mha", ElementNumberOfChannels=3),
    "MetaImage of a huge size": metaimage("v.mha", DimSize="40000 40000 40000"),
    "MetaImage that leaves": metaimage("v.mhd", "../v.raw"),
    "MetaImage cut": cut(metaimage("v.mha"), 0.9),
}


def made(folder: Path) -> Iterator[dict[str, Any]]:
    """The made files, each in a folder of its own."""
    for number, (name, write) in enumerate(VOLUMES.items()):
        place = folder / f"volume-{number}"
        place.mkdir()
        path = write(place)
        yield {"name": name, "kind": "volume", "path": str(path), "folder": str(place), **read(path)}
    for number, case in enumerate([*CASES, *REPEATED]):
        if case.needs and find_spec(case.needs) is None:
            continue
        place = folder / f"series-{number}"
        place.mkdir()
        path = case.write(place).path
        wanted = {"series": case.series, "phase": case.phase, "resample_slices": case.resample_slices}
        named = {"name": case.name, "kind": "series", "path": str(path), "folder": str(place)}
        truth = named | {"wanted": wanted} | read(path, **wanted)
        if case.loss:
            truth["values"] = str(folder / f"series-{number}.f32")
            np.ascontiguousarray(read_volume(path).array, np.float32).tofile(truth["values"])
        yield truth


def straightened(folder: Path) -> dict[str, Any]:
    """A DICOM series of sections across a vessel that bends from the head to the left."""
    turn = np.linspace(0, np.pi, 61)
    middle = np.mean(scan().corners, axis=0)
    bow = Vessel(middle + 8 * np.stack([-np.cos(turn), 0 * turn, np.sin(turn)], axis=1))
    straightened_volume(scan(), bow, 8.0, 1.0).save(folder / "straightened")
    path = str(folder / "straightened")
    return {
        "name": "a straightened vessel",
        "kind": "series",
        "path": path,
        "folder": path,
        **read(Path(path)),
    }


def bytes_of(path: Path) -> int:
    """The size of a file or of all files in a folder."""
    return sum(file.stat().st_size for file in (path.rglob("*") if path.is_dir() else [path]))


def shared() -> Iterator[dict[str, Any]]:
    """The volumes of the shared data; the large ones only in the long tests."""
    endings = (".nii.gz", ".nrrd", ".mha")
    files = [path for path in sorted(DATA.rglob("*")) if path.name.endswith(endings)]
    most = math.inf if os.environ.get("LUMENCUT_LONG") else MOST_BYTES
    for path in (*files, *sorted((DATA / "dicom").glob("ct-*"))):
        if bytes_of(path) > most:
            continue
        kind = "series" if path.is_dir() else "volume"
        name = str(path.relative_to(DATA))
        named = {"name": name, "kind": kind, "path": str(path), "folder": str(path.parent)}
        yield named | read(path)
        if "missing" in name:
            wanted = {"fill_gaps": True}
            yield named | {"name": f"{name}, filled", "wanted": wanted} | read(path, **wanted)


def main() -> None:
    """Write everything."""
    logging.getLogger("lumencut").setLevel(logging.ERROR)
    folder = Path(sys.argv[1])
    # One thread asks one decoder at a time.
    set_threads(1)
    workers.Worker = SharedDecoder  # type: ignore[misc]
    every = [*made(folder), straightened(folder), *shared()]
    SharedDecoder().end()
    (folder / "expected.json").write_text(json.dumps(every, indent=1))


if __name__ == "__main__":
    main()
