"""The GPU from Python: the choice of `auto`, behaviour after a failure, threads and processes."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import threading
import warnings
from dataclasses import FrozenInstanceError

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

from device_scenes import pair, scene
from frame_comparison import assert_alike
from lumencut import (
    Camera,
    DeviceError,
    DeviceWarning,
    Renderer,
    Settings,
    SettingsError,
    TransferFunction,
    Volume,
    Window,
    devices,
)
from lumencut.cli import main
from scene_files import write_lines, write_volume
from scenes import wandering


def test_the_gpu_that_computes_is_one_of_the_listed(gpu):
    listed = devices()
    assert gpu == listed[0].name
    assert gpu != "cpu"
    for device in listed:
        assert device.name
        assert device.driver
        assert device.backend in ("vulkan", "metal", "dx12")
        assert device.volume_side >= 256
        assert device.buffer_bytes >= 1 << 27
    assert [device.is_software for device in listed] == sorted(device.is_software for device in listed)
    with pytest.raises(FrozenInstanceError):
        listed[0].name = "another"


def test_an_unknown_device_is_refused(monkeypatch):
    for device in ("tpu", None, 0):
        with pytest.raises(SettingsError, match=r"device: found .*; expected one of 'auto', 'cpu', 'gpu'"):
            Renderer(None, wandering(1), device)
    monkeypatch.setenv("LUMENCUT_AUTO_DEVICE", "quantum")
    with pytest.raises(SettingsError, match="LUMENCUT_AUTO_DEVICE: found 'quantum'; expected cpu, hardware"):
        Renderer(None, wandering(1))
    assert Renderer(None, wandering(1), "cpu").device == "cpu"


def test_auto_takes_hardware_or_else_the_cpu(monkeypatch):
    hardware = [device.name for device in devices() if not device.is_software]
    expected = hardware[0] if hardware else "cpu"
    for value in ("", "hardware"):
        monkeypatch.setenv("LUMENCUT_AUTO_DEVICE", value)
        assert {Renderer(None, wandering(1)).device for _ in range(2)} == {expected}
    monkeypatch.setenv("LUMENCUT_AUTO_DEVICE", "cpu")
    assert Renderer(None, wandering(1)).device == "cpu"


def test_without_a_driver_auto_is_the_cpu_and_gpu_is_refused(tmp_path):
    code = """
import sys, warnings
import lumencut
from scenes import wandering
warnings.simplefilter("error")
assert lumencut.devices() == []
assert lumencut.Renderer(None, wandering(1)).device == "cpu"
try:
    lumencut.Renderer(None, wandering(1), "gpu")
except lumencut.DeviceError as error:
    assert isinstance(error, RuntimeError)
    print(error)
"""
    if sys.platform != "linux":
        pytest.skip("only Vulkan can be told to use no driver")
    nothing = str(tmp_path / "no-driver.json")
    changes = {"VK_DRIVER_FILES": nothing, "VK_ICD_FILENAMES": nothing, "LUMENCUT_AUTO_DEVICE": "any"}
    told = run_python(code, changes)
    assert told.startswith("device: found no GPU with a driver for Vulkan")
    assert "the device 'cpu'" in told


@pytest.mark.skipif(sys.platform != "linux", reason="only Mesa's layer complains")
@pytest.mark.usefixtures("gpu")
def test_without_a_display_nothing_is_said_on_stderr():
    hidden = ("DISPLAY", "WAYLAND_DISPLAY", "XDG_RUNTIME_DIR", "NODEVICE_SELECT", "MESA_VK_DEVICE_SELECT")
    bare = {name: value for name, value in os.environ.items() if name not in hidden}
    code = "import lumencut; lumencut.devices()"
    command = [sys.executable, "-c", code]
    bare["PYTHONPATH"] = os.pathsep.join(sys.path)
    told = subprocess.run(command, env=bare, capture_output=True, text=True, check=True, timeout=60)
    assert told.stderr == ""


def run_python(code, changes=None, timeout=120):
    """Run code in its own interpreter, so that an endless wait fails the test; return its output."""
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)} | (changes or {})
    told = subprocess.run(
        [sys.executable, "-c", code],
        env=environment,
        timeout=timeout,
        capture_output=True,
        text=True,
        check=False,
    )
    assert told.returncode == 0, told.stderr
    return told.stdout


def too_large():
    """A volume with more voxels along one side than any adapter allows."""
    side = max(device.volume_side for device in devices())
    return Volume(np.arange(side + 1, dtype=np.uint16)[:, None, None])


def test_what_is_too_large_falls_back_to_the_cpu_once(any_gpu):
    volume = too_large()
    camera, settings = (
        Camera.anterior(volume, (20, 30)),
        Settings(context="mip", context_window=Window(500, 999)),
    )
    renderer = Renderer(volume)
    assert renderer.device == any_gpu
    with pytest.warns(DeviceWarning, match=r"found .*; expected at most .*; the CPU continues") as told:
        found = renderer.render(camera, settings)
    assert told[0].filename == __file__
    assert renderer.device == "cpu"
    expected = Renderer(volume, None, "cpu").render(camera, settings)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        again = renderer.render(camera, settings)
    for frame in (found, again):
        np.testing.assert_array_equal(frame.image, expected.image)
    assert expected.image.any()
    # Other renderers still use the GPU.
    assert Renderer(*scene("phantom")).device == any_gpu


@pytest.mark.usefixtures("gpu")
def test_what_is_too_large_is_an_error_where_the_gpu_is_asked_for(gpu):
    volume = too_large()
    camera = Camera.anterior(volume, (20, 30))
    renderer = Renderer(volume, None, "gpu")
    for _ in range(2):
        with pytest.raises(DeviceError, match="compute with the device 'cpu'"):
            renderer.render(camera, Settings(context="mip", context_window=Window(500, 999)))
    assert renderer.device == gpu
    found, expected = (Renderer(*scene("phantom"), device) for device in ("gpu", "cpu"))
    camera = Camera.left(expected.scene, (30, 40))
    assert_alike(found.render(camera), expected.render(camera))


@pytest.mark.parametrize("error", [SettingsError])
def test_other_errors_are_the_same_on_the_gpu(any_gpu, error):
    renderer = Renderer(scene("phantom")[0])
    with pytest.raises(error, match="context_step: found"):
        renderer.render(settings=Settings(context_step=0.001))
    assert renderer.device == any_gpu


@pytest.mark.usefixtures("interruptible", "gpu")
def test_ctrl_c_ends_a_rendering_and_the_renderer_goes_on():
    found, expected = pair("phantom", with_tree=False)
    ended, main_thread = threading.Event(), threading.get_ident()

    def interrupt_once_it_runs():
        while sys._current_frames()[main_thread].f_code.co_name != "render" and not ended.wait(0.02):
            pass
        if not ended.wait(0.05):
            signal.raise_signal(signal.SIGINT)

    def render_on_and_on():
        for _ in range(100_000):
            found.render(large, slow)

    thread = threading.Thread(target=interrupt_once_it_runs)
    # Takes seconds on a software GPU; on other GPUs one of many frames is interrupted.
    clear = TransferFunction([(0, (255, 255, 255), 1e-6)])
    slow = Settings(context="dvr", context_window=Window(350, 900), context_transfer=clear, context_step=0.1)
    large = Camera.anterior(found.scene, (150, 150))
    thread.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            render_on_and_on()
    finally:
        ended.set()
        thread.join()
    small = Camera.anterior(expected.scene, (50, 40))
    assert_alike(found.render(small), expected.render(small))


@pytest.mark.usefixtures("gpu")
def test_threads_may_share_a_renderer_and_the_gpu():
    run_python("""
from concurrent.futures import ThreadPoolExecutor
from device_scenes import SETTINGS, oblique, pair, scene
from frame_comparison import assert_alike
from lumencut import Renderer
shared, expected = pair("phantom")
renderers = [shared, Renderer(*scene("phantom"), "gpu"), expected]
views = [(oblique(shared.scene, (41, n)), SETTINGS[name]) for n, name in ((30, "mip"), (31, "no context"))]
frames = [expected.render(*view) for view in views]
with ThreadPoolExecutor(4) as pool:
    found = list(pool.map(lambda n: renderers[n % 3].render(*views[n % 2]), range(18)))
for n, frame in enumerate(found):
    if n % 3 < 2:
        assert_alike(frame, frames[n % 2])
""")


@pytest.mark.parametrize("device", ["auto", "gpu"])
@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system has no fork")
def test_a_forked_process_renders_too(any_gpu, device):
    told = run_python(
        f"""
import os, sys, warnings
from device_scenes import Camera, Renderer, scene
from frame_comparison import assert_alike
from lumencut import DeviceError
warnings.simplefilter("ignore")
renderer, expected = Renderer(*scene("phantom"), {device!r}), Renderer(*scene("phantom"), "cpu")
camera = Camera.anterior(expected.scene, (50, 40))
assert renderer.device != "cpu"
assert_alike(renderer.render(camera), expected.render(camera))
child = os.fork()
if child == 0:
    try:
        assert_alike(renderer.render(camera), expected.render(camera))
        fresh = Renderer(*scene("phantom"), {device!r})
        assert_alike(fresh.render(camera), expected.render(camera))
        os.write(1, f"child: {{fresh.device}}".encode())
        del renderer, fresh
    except DeviceError as error:
        os.write(1, str(error).encode())
    except BaseException as error:
        os.write(2, repr(error).encode())
        os._exit(1)
    os._exit(0)
status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
assert_alike(renderer.render(camera), expected.render(camera))
sys.exit(status)
""",
        timeout=60,
    )
    # Some hardware drivers do not work in forked processes: with device "gpu" the user gets an error.
    may_refuse = device == "gpu" and not devices()[0].is_software
    is_refused = may_refuse and "start processes by 'spawn' instead of 'fork'" in told
    assert is_refused or told in (f"child: {any_gpu}", "child: cpu")


def info(*words):
    result = CliRunner().invoke(main, ["info", *words])
    assert result.exit_code == 0, result.output
    return result.stdout


def test_info_lists_the_gpus(tmp_path, monkeypatch):
    monkeypatch.setenv("LUMENCUT_AUTO_DEVICE", "cpu")
    told, found = info("--devices"), json.loads(info("--devices", "--json"))
    assert told.endswith("auto takes: cpu\n")
    assert (found["auto"], found["files"], found["compared"]) == ("cpu", [], [])
    assert [one["name"] for one in found["devices"]] == [device.name for device in devices()]
    for device in devices():
        assert device.name in told
        assert ("computes only with --device gpu" in told) or not device.is_software
    both = info("--devices", str(write_volume(tmp_path / "ct.nii.gz")))
    assert both.startswith(told)
    assert "24, 20, 32" in both
    result = CliRunner().invoke(main, ["info"])
    assert result.exit_code == 2
    assert "Missing argument 'FILE…'" in result.stderr


@pytest.mark.parametrize("command", ["render", "turntable"])
def test_the_commands_compute_where_they_are_told(gpu, command, tmp_path, monkeypatch):
    monkeypatch.setenv("LUMENCUT_AUTO_DEVICE", "cpu")
    files = [str(write_volume(tmp_path / "ct.nii.gz")), str(write_lines(tmp_path / "lines.vtk"))]
    more = ["--frames", "2"] if command == "turntable" else []
    shown = {}
    for device, name in (("gpu", gpu), ("cpu", "cpu"), ("auto", "cpu")):
        output = ["-o", str(tmp_path / f"{device}.png"), "--size", "20x24", "--device", device, "--verbose"]
        result = CliRunner().invoke(main, [command, *files, *output, *more])
        assert result.exit_code == 0, result.output
        assert f"device: {name}\n" in result.stderr
        with Image.open(tmp_path / f"{device}.png") as picture:
            shown[device] = np.asarray(picture.convert("RGB"))
    assert shown["gpu"].shape == (24, 20, 3)
    assert shown["cpu"].std() > 10
    assert np.array_equal(shown["auto"], shown["cpu"])
    assert (np.abs(shown["gpu"].astype(int) - shown["cpu"]) > 2).mean() < 0.01


def test_a_missing_gpu_is_one_line_and_exit_code_1(tmp_path, monkeypatch):
    def missing(*_):
        raise DeviceError("device", "no GPU", "a GPU", "compute with the device 'cpu'")

    monkeypatch.setattr("lumencut.pictures.renderer._lumencut.Renderer", missing)
    files = [str(write_volume(tmp_path / "ct.nii.gz")), str(write_lines(tmp_path / "lines.vtk"))]
    result = CliRunner().invoke(main, ["render", *files, "-o", str(tmp_path / "out.png"), "--device", "gpu"])
    assert result.exit_code == 1
    assert (
        result.stderr
        == "lumencut: error: device: found no GPU; expected a GPU; compute with the device 'cpu'\n"
    )


def test_a_gpu_that_is_given_up_is_a_warning_in_one_line(any_gpu, tmp_path):
    import nibabel

    array = np.swapaxes(too_large().array, 0, 2)
    # As long as a body, so that no doubt about its size is reported.
    image = nibabel.Nifti1Image(array, np.diag([0.25, 0.25, 0.25, 1.0]))
    image.header.set_xyzt_units("mm")
    nibabel.save(image, tmp_path / "long.nii")
    words = ["render", str(tmp_path / "long.nii"), "-o", str(tmp_path / "out.png"), "--size", "9x9"]
    result = CliRunner().invoke(main, [*words, "--verbose"])
    assert result.exit_code == 0, result.output
    assert result.stderr.count("lumencut: warning: ") == 1
    assert "; the CPU continues\n" in result.stderr
    assert "device: cpu\n" in result.stderr
