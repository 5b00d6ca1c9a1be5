"""Pull and push with a real PACS, Orthanc, in a network that ends at this machine.

Orthanc listens on all interfaces whatever its settings say, so it gets a network with none but loopback.
"""

import os
import subprocess
import sys
from pathlib import Path

import pytest

CASES = Path(__file__).with_name("orthanc_cases.py")


@pytest.mark.skipif(sys.platform != "linux", reason="networks of their own are a matter of Linux")
def test_orthanc_takes_and_gives_what_it_is_asked():
    mapped = [] if os.geteuid() == 0 else ["--map-root-user"]
    script = (
        f"ip link set lo up && exec {sys.executable} -m pytest -q -p no:xdist -p no:cacheprovider {CASES}"
    )
    done = subprocess.run(
        ["unshare", *mapped, "--net", "sh", "-c", script], capture_output=True, text=True, timeout=180
    )
    assert done.returncode == 0, done.stdout + done.stderr
