"""CPR on the GPU compared with the CPU."""

from __future__ import annotations

import numpy as np
import pytest

from cpr_scenes import noise, wave
from device_scenes import scene
from image_comparison import compare
from lumencut import DeviceError, DeviceWarning, Opacity, Settings, Slab, cfa, cpr, devices
from test_cpr import each_mode

SETTINGS = {
    "default": Settings(),
    "slab max": Settings(slab=Slab(4, "max")),
    "slab mean": Settings(slab=Slab(3, "mean"), opacity=Opacity(0, 300), background=(10, 200, 30, 128)),
    "slab min": Settings(slab=Slab(2, "min")),
}


def assert_alike(one, other):
    """Values agree within 0.1 and pictures within one grey value, except for one pixel in a thousand."""
    pixels = one.value.size
    assert compare(one.value, other.value, 0.1).count <= pixels / 1000
    assert compare(one.image, other.image, 1).count <= pixels / 1000


@each_mode
@pytest.mark.parametrize("name", SETTINGS)
@pytest.mark.usefixtures("gpu")
def test_pictures_of_noise(mode, name):
    volume, line = noise("sheared"), wave()
    made = [
        cpr(volume, line, mode, 70, 0.6, 0.4, settings=SETTINGS[name], device=device)
        for device in ("gpu", "cpu")
    ]
    assert np.isnan(made[0].value).any()
    assert np.ptp(made[0].image[..., 0]) > 200
    assert_alike(*made)
    assert_alike(*(one.rotated(1.1) for one in made))


@each_mode
@pytest.mark.usefixtures("gpu")
def test_pictures_of_a_phantom(mode):
    volume, tree = scene("phantom")
    for line in tree[:3]:
        assert_alike(*(cpr(volume, line, mode, device=device) for device in ("gpu", "cpu")))


@pytest.mark.usefixtures("gpu")
def test_aggregated_features():
    one, other = (cfa(noise(), wave(), 4, "max", 1.0, device=device) for device in ("gpu", "cpu"))
    assert_alike(one, other)


@pytest.mark.usefixtures("any_gpu")
def test_the_cpu_takes_over_where_the_gpu_has_no_room():
    if (most := devices()[0].buffer_bytes) > 1 << 28:
        pytest.skip(f"no picture of a test is too large for buffers of {most} bytes")
    # 48 bytes for each of three million pixels exceed the 128 MiB that a shader may bind.
    spacing = 0.02
    words = "curved geometry: found [0-9]+ pixels"
    made = cpr(noise(), wave(), "straightened", 30, spacing, device="auto")
    assert made.size[0] * made.size[1] > 3_000_000
    with pytest.warns(DeviceWarning, match=f"{words}.*; the CPU continues"):
        value = made.value
    np.testing.assert_array_equal(
        value, cpr(noise(), wave(), "straightened", 30, spacing, device="cpu").value
    )
    with pytest.raises(DeviceError, match=words):
        _ = cpr(noise(), wave(), "straightened", 30, spacing, device="gpu").value
