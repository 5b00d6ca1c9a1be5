"""Which batch may write into the folder of a cohort, and the syntax of limits."""

from __future__ import annotations

import json
import os
import socket
import sys
import time

import click
import pytest

import lumencut
from lumencut.cli.batch import _TIMES
from lumencut.cli.parameters import BYTES, Quantity
from lumencut.cohort import lock
from lumencut.cohort.batch import checked_shard
from lumencut.cohort.layout import Layout
from lumencut.cohort.lock import Shard, held
from lumencut.errors import FileError, SettingsError

pytestmark = pytest.mark.skipif(os.name != "posix", reason="locks are those of POSIX")


@pytest.fixture
def layout(tmp_path):
    made = Layout(tmp_path)
    made.make()
    return made


def write_lock(layout, name="lock-1-of-1.json", age=0.0, **owner):
    path = layout.own / name
    here = {"host": socket.gethostname(), "process": os.getpid(), "started": "0"}
    path.write_text(json.dumps({**here, **owner}), "ascii")
    os.utime(path, (time.time() - age,) * 2)


def test_one_batch_at_a_time_writes_into_a_folder(layout):
    with held(layout, Shard()):
        with pytest.raises(FileError, match=f"process {os.getpid()}"), held(layout, Shard()):
            pass
        with pytest.raises(FileError, match="another batch"), held(layout, Shard(1, 2)):
            pass
    assert list(layout.own.glob("lock-*")) == []


def test_shards_of_one_division_work_beside_each_other(layout):
    with held(layout, Shard(1, 2)), held(layout, Shard(2, 2)):
        with pytest.raises(FileError), held(layout, Shard(1, 2)):
            pass
        with pytest.raises(FileError), held(layout, Shard(3, 3)):
            pass
    studies = [[place for place in range(7) if Shard(number, 3).has(place)] for number in (1, 2, 3)]
    assert studies == [[0, 3, 6], [1, 4], [2, 5]]
    assert (Shard(), Shard().is_all, Shard(1, 2).is_all) == (Shard(1, 1), True, False)


def test_a_lock_is_renewed_now_and_then(layout, monkeypatch):
    now = [1000.0]
    monkeypatch.setattr(lock.time, "monotonic", lambda: now[0])
    path = layout.own / "lock"
    path.touch()
    os.utime(path, (1, 1))
    held_lock = lock.Lock(path)
    for later, is_renewed in ((0.9, False), (0.2, True)):
        now[0] += later * lock._ALIVE_EVERY
        held_lock.renew()
        assert (path.stat().st_mtime > 1) == is_renewed


def test_a_living_process_is_looked_for_and_gets_no_signal(layout, monkeypatch):
    sent = []
    monkeypatch.setattr(lock.os, "kill", lambda *order: sent.append(order))
    with held(layout, Shard()), pytest.raises(FileError), held(layout, Shard()):
        pass
    assert set(sent) == {(os.getpid(), 0)}


@pytest.mark.skipif(sys.platform != "linux", reason="other systems do not tell when a process began")
def test_the_start_of_a_process_tells_it_from_a_later_one_of_the_same_id():
    assert lock._started(os.getpid()).isdigit()
    assert lock._started(os.getpid()) != lock._started(1)


def test_locks_of_the_dead_are_taken_over(layout):
    # The process started at another time than the one that wrote the lock: its process id was reused.
    write_lock(layout)
    with held(layout, Shard()):
        pass
    (layout.own / "lock-1-of-1.json").write_text("", "ascii")
    with held(layout, Shard()):
        pass
    write_lock(layout, "lock-2-of-5.json", host="elsewhere", age=600)
    with held(layout, Shard()):
        pass


def test_locks_of_the_living_on_other_machines_hold(layout):
    write_lock(layout, host="elsewhere", age=60)
    with pytest.raises(FileError, match="on elsewhere"), held(layout, Shard()):
        pass


@pytest.mark.parametrize("shard", [(0, 3), (4, 3), (1,), (1.5, 2)])
def test_impossible_shards_are_refused(shard):
    with pytest.raises(SettingsError, match="shard"):
        checked_shard(shard)


@pytest.mark.parametrize(
    ("text", "units", "value"),
    [
        ("8GB", BYTES, 8 << 30),
        ("1.5 GiB", BYTES, 3 << 29),
        ("512m", BYTES, 512 << 20),
        ("90min", _TIMES, 5400),
        ("2h", _TIMES, 7200),
        ("45", _TIMES, 45),
        ("much", BYTES, None),
        ("3 weeks", _TIMES, None),
        ("1.2.3s", _TIMES, None),
    ],
)
def test_limits_are_numbers_with_units(text, units, value):
    kind = Quantity("SIZE", units, "8GB")
    if value is None:
        with pytest.raises(click.BadParameter):
            kind.convert(text, None, None)
    else:
        assert kind.convert(text, None, None) == value


@pytest.mark.parametrize(
    ("wrong", "word"),
    [
        ({"jobs": 0}, "jobs"),
        ({"memory": 5}, "memory"),
        ({"time_limit": -1}, "time_limit"),
        ({"threads": 0}, "threads"),
    ],
)
def test_impossible_limits_are_refused(tmp_path, wrong, word):
    (tmp_path / "studies.csv").write_text("id,volume\na,a.nii\n", "utf-8")
    with pytest.raises(SettingsError, match=word):
        lumencut.batch(tmp_path / "studies.csv", tmp_path / "out", **wrong)
    assert not (tmp_path / "out").exists()
