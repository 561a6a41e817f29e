"""Ctrl-C and SIGTERM: what is finished is on disk, whole."""

from __future__ import annotations

import json
import signal
import threading
import time

import landfall
import pytest
from conftest import landfall_process
from landfall.map_pictures import GrowingMapGif


@pytest.mark.parametrize("signal_number", [signal.SIGINT, signal.SIGTERM])
def test_stop_leaves_whole_files(files, scans, signal_number):
    many = [scan for _ in range(400) for scan in scans]
    for k, scan in enumerate(many):
        scan.stamp_s = float(k)
    landfall.save_log(many, files.log)
    results, out = files.folder / "r.jsonl", files.folder / "p.tum"
    process = landfall_process(
        "relocalize", "--map", files.map, "--log", files.log, "--results", results, "--out", out,
        "--method", "exhaustive", cwd=files.folder,
    )  # fmt: skip
    part = results.with_name("r.jsonl.part")
    wait_until(lambda: part.exists() and part.read_text().count("\n") >= 2, process)
    process.send_signal(signal_number)
    _, err = process.communicate(timeout=30)

    assert process.returncode == 128 + signal_number
    assert "stopped after" in err and "Traceback" not in err
    lines = [json.loads(line) for line in results.read_text().splitlines()]
    assert 2 <= len(lines) < len(many)
    assert [line["index"] for line in lines] == list(range(len(lines)))
    answered = sum(bool(line["hypotheses"]) for line in lines)
    assert len(landfall.load_trajectory(out)) == answered
    assert not part.exists()


def wait_until(condition, process, limit_s=30.0):
    until = time.monotonic() + limit_s
    while not condition():
        assert process.poll() is None, process.communicate()
        assert time.monotonic() < until
        time.sleep(0.02)


def test_slam_stops_with_the_map_so_far(files, landfall_command, monkeypatch):
    def add_and_stop_at_the_third(gif, grid, path):
        add(gif, grid, path)
        if len(path) == 3:
            signal.raise_signal(signal.SIGINT)

    add = GrowingMapGif.add
    monkeypatch.setattr(GrowingMapGif, "add", add_and_stop_at_the_third)
    out, path, gif = files.folder / "made.yaml", files.folder / "path.tum", files.folder / "made.gif"
    done = landfall_command(
        "map", "--method", "slam", "--log", files.log, "--out", out, "--trajectory", path, "--animation", gif
    )
    assert done.code == 130 and "stopped after 3 of 12 scans" in done.err
    assert [stamp_s for stamp_s, _ in landfall.load_trajectory(path)] == [100.0, 101.0, 102.0]
    assert (landfall.load_grid_map(out).cells == 1).any() and gif.stat().st_size > 0


@pytest.fixture
def heeded_ctrl_c():
    """Where the tests run in the background, the shell has SIGINT ignored."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("heeded_ctrl_c")
def test_ctrl_c_ends_a_batch_from_python(prepared, scans):
    """A minute of work; the signal comes from a timer, as from a terminal."""
    many = [scan for _ in range(100) for scan in scans]
    timer = threading.Timer(0.5, lambda: signal.raise_signal(signal.SIGINT))
    started_s = time.monotonic()
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        landfall.search(prepared, None, many, method="exhaustive", rotation_step_rad=2e-4, time_budget_s=0.1)
    assert time.monotonic() - started_s < 20.0
    timer.join()
    assert landfall.search(prepared, None, scans[:2])[1].verdict == "found"  # as before
