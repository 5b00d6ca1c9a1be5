"""Runs SLURM with one node on this machine: munge, controller and daemon, only on loopback.

Needs root, and Debian's packages slurm-wlm and munge.
"""

from __future__ import annotations

import os
import shutil
import socket
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

_PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch")
_CONFIGURATION = """ClusterName=lumencut
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
SlurmdUser=root
SlurmctldPort={first}
SlurmdPort={second}
AuthType=auth/munge
AuthInfo=socket={home}/socket
StateSaveLocation={home}/state
SlurmdSpoolDir={home}/spool
SlurmctldPidFile={home}/slurmctld.pid
SlurmdPidFile={home}/slurmd.pid
SlurmctldLogFile={home}/slurmctld.log
SlurmdLogFile={home}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
SchedulerParameters=sched_interval=1
NodeName={host} NodeAddr=127.0.0.1 CPUs=2 RealMemory=8000 State=UNKNOWN
PartitionName=long Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def is_there() -> bool:
    """Return whether SLURM can run on this machine."""
    return os.name == "posix" and os.geteuid() == 0 and all(map(shutil.which, _PROGRAMS))


@contextmanager
def slurm(home: Path) -> Iterator[dict[str, str]]:
    """Run SLURM in a folder; yield the environment in which its commands find it."""
    for name in ("state", "spool"):
        (home / name).mkdir()
    home.chmod(0o755)
    (home / "key").write_bytes(os.urandom(1024))
    (home / "key").chmod(0o400)
    first, second = _free_ports()
    text = _CONFIGURATION.format(host=socket.gethostname(), home=home, first=first, second=second)
    (home / "slurm.conf").write_text(text, "ascii")
    environment = {**os.environ, "SLURM_CONF": str(home / "slurm.conf")}
    files = {name: home / name for name in ("key", "socket", "munge.pid", "munge.log", "seed")}
    munge = ["munged", "--foreground", "--force", f"--key-file={files['key']}", f"--socket={files['socket']}"]
    munge += [f"--pid-file={files['munge.pid']}", f"--log-file={files['munge.log']}"]
    daemons = [[*munge, f"--seed-file={files['seed']}"], ["slurmctld", "-D"], ["slurmd", "-D"]]
    running = []
    try:
        for daemon in daemons:
            pipes = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
            running.append(subprocess.Popen(daemon, env=environment, **pipes))
            time.sleep(1)
        _wait_for_the_node(environment)
        yield environment
    finally:
        for process in reversed(running):
            process.terminate()
            try:
                process.wait(30)
            except subprocess.TimeoutExpired:
                # The others must end too.
                process.kill()
                process.wait()


def _free_ports() -> tuple[int, int]:
    with socket.socket() as first, socket.socket() as second:
        for one in (first, second):
            one.bind(("127.0.0.1", 0))
        return first.getsockname()[1], second.getsockname()[1]


def _wait_for_the_node(environment: dict[str, str]) -> None:
    """Wait until the node accepts jobs."""
    end = time.monotonic() + 60
    while True:
        told = subprocess.run(["sinfo", "-h", "-o", "%T"], env=environment, capture_output=True, text=True)
        if told.stdout.strip() == "idle":
            return
        assert time.monotonic() < end, told.stdout + told.stderr
        time.sleep(0.5)
