"""Time to read a long DICOM series, against the decoder alone.

Writes a noisy phantom in every codec and reads it with `lumencut.read_volume` and, file by file, with pydicom
and the same plugin. Each run has its own process, because first use of memory dominates; imports are not
counted. "Ratio" is the speed of Lumencut divided by that of the decoder.
"""

from __future__ import annotations

import argparse
import tempfile
import time
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import pydicom
from pydicom.dataset import Dataset, FileMetaDataset
from pydicom.uid import CTImageStorage, ExplicitVRLittleEndian, generate_uid

from lumencut import read_volume

SIZE = 512
DISTINCT = 8
"""Number of different slices; the series repeats them."""
CODECS = {
    "uncompressed": (ExplicitVRLittleEndian, ""),
    "RLE": ("1.2.840.10008.1.2.5", "pydicom"),
    "JPEG lossless": ("1.2.840.10008.1.2.4.70", "gdcm"),
    "JPEG-LS": ("1.2.840.10008.1.2.4.80", "gdcm"),
    "JPEG 2000": ("1.2.840.10008.1.2.4.90", "pylibjpeg"),
}


def phantom(k: int) -> np.ndarray:
    """A disc with vessels and noise, as stored values."""
    j, i = np.indices((SIZE, SIZE)) - SIZE / 2
    tissue = np.where(np.hypot(i, j) < 200, 1064, 24)
    tissue[np.hypot(i - 40 * np.cos(k), j) < 12] = 1364
    noise = np.random.default_rng(k).normal(0, 12, tissue.shape)
    return np.clip(tissue + noise, 0, 4095).astype(np.uint16)


def encoded(k: int, syntax: str) -> Dataset:
    """One slice in a transfer syntax."""
    data = Dataset()
    data.file_meta = FileMetaDataset()
    data.file_meta.TransferSyntaxUID = ExplicitVRLittleEndian
    data.SOPClassUID = data.file_meta.MediaStorageSOPClassUID = CTImageStorage
    data.SOPInstanceUID = data.file_meta.MediaStorageSOPInstanceUID = generate_uid()
    data.SeriesInstanceUID, data.SeriesNumber, data.Modality = "1.2.3", 1, "CT"
    data.Rows = data.Columns = SIZE
    data.SamplesPerPixel, data.PhotometricInterpretation = 1, "MONOCHROME2"
    data.BitsAllocated, data.BitsStored, data.HighBit, data.PixelRepresentation = 16, 12, 11, 0
    data.RescaleSlope, data.RescaleIntercept = "1", "-1024"
    data.PixelSpacing, data.ImageOrientationPatient = ["0.7", "0.7"], [1, 0, 0, 0, 1, 0]
    data.PixelData = phantom(k).tobytes()
    data["PixelData"].VR = "OW"
    if syntax in ("1.2.840.10008.1.2.5", "1.2.840.10008.1.2.4.90"):
        data.compress(syntax)
    elif syntax != ExplicitVRLittleEndian:
        data = transcoded(data, syntax)
    return data


def transcoded(data: Dataset, syntax: str) -> Dataset:
    """The same slice compressed by GDCM, which works on files."""
    import gdcm

    with tempfile.NamedTemporaryFile(suffix=".dcm") as file:
        pydicom.dcmwrite(file.name, data, enforce_file_format=True)
        reader = gdcm.ImageReader()
        reader.SetFileName(file.name)
        assert reader.Read()
        change = gdcm.ImageChangeTransferSyntax()
        change.SetTransferSyntax(gdcm.TransferSyntax(gdcm.TransferSyntax.GetTSType(syntax)))
        change.SetInput(reader.GetImage())
        assert change.Change()
        writer = gdcm.ImageWriter()
        writer.SetFileName(file.name)
        writer.SetFile(reader.GetFile())
        writer.SetImage(change.GetOutput())
        assert writer.Write()
        return pydicom.dcmread(file.name)


def write_series(folder: Path, syntax: str, count: int) -> None:
    """Write `count` slices, 0.5 mm apart."""
    several = [encoded(k, syntax) for k in range(DISTINCT)]
    for k in range(count):
        data = several[k % DISTINCT]
        data.ImagePositionPatient, data.InstanceNumber = [0, 0, 0.5 * k], k + 1
        data.SOPInstanceUID = data.file_meta.MediaStorageSOPInstanceUID = generate_uid()
        if "PixelData" in data and syntax != ExplicitVRLittleEndian:
            data["PixelData"].is_undefined_length = True
        pydicom.dcmwrite(folder / f"{k:05}.dcm", data, enforce_file_format=True)


def decoder_alone(folder: Path, plugin: str, count: int) -> None:
    """Decode all files into one array, ignoring their positions."""
    volume = np.empty((count, SIZE, SIZE), np.uint16)
    for k, path in enumerate(sorted(folder.iterdir())):
        data = pydicom.dcmread(path)
        data.pixel_array_options(decoding_plugin=plugin)
        volume[k] = data.pixel_array


def seconds(work: Callable[[], object]) -> float:
    """Seconds that `work` takes, without imports."""
    import lumencut.dicom.reading.pixels  # noqa: F401

    pydicom.pixels.get_decoder(ExplicitVRLittleEndian)
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def compared(folder: Path, plugin: str, count: int, runs: int) -> tuple[float, float]:
    """Median times of the decoder alone and of Lumencut, alternating."""
    works = partial(decoder_alone, folder, plugin, count), partial(read_volume, folder)
    taken: tuple[list[float], list[float]] = [], []
    with ProcessPoolExecutor(1, get_context("spawn"), max_tasks_per_child=1) as processes:
        for _ in range(runs):
            for work, times in zip(works, taken, strict=True):
                times.append(processes.submit(seconds, work).result())
    return float(np.median(taken[0])), float(np.median(taken[1]))


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--slices", type=int, default=1305)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--codecs", nargs="*", default=list(CODECS), choices=list(CODECS))
    chosen = parser.parse_args()
    print("| codec | slices | decoder alone (s) | `read_volume` (s) | ratio |")
    print("| --- | --- | --- | --- | --- |")
    for name in chosen.codecs:
        syntax, plugin = CODECS[name]
        with tempfile.TemporaryDirectory() as temporary:
            folder = Path(temporary)
            write_series(folder, syntax, chosen.slices)
            alone, ours = compared(folder, plugin, chosen.slices, chosen.runs)
        print(f"| {name} | {chosen.slices} | {alone:.2f} | {ours:.2f} | {alone / ours:.2f} |", flush=True)


if __name__ == "__main__":
    main()
