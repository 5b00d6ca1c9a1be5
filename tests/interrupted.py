"""Runs processes and interrupts them while they work."""

import signal
import subprocess
import sys


def ends_by_ctrl_c(code: str, word: str) -> None:
    """Run Python code that prints a word once it works; interrupt it; check that it reports that and ends."""
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as process:
        try:
            assert process.stdout.readline() == f"{word}\n"
            process.send_signal(signal.SIGINT)
            output, _ = process.communicate(timeout=60)
        finally:
            process.kill()
    assert output.splitlines()[-1] == "interrupted"
    assert process.returncode == 0
