"""The programs of docs/python.md, taken out of it and run one after the other, as its first lines promise."""

from __future__ import annotations

import contextlib
import io
import math
import re
from pathlib import Path

import landfall

GUIDE = Path(__file__).resolve().parents[2] / "docs" / "python.md"
PLAN = [[0, 0, 6, 0], [6, 0, 6, 4], [6, 4, 2, 4], [2, 4, 0, 3], [0, 3, 0, 0]]


def write_files(folder):
    floor = landfall.WallMap(PLAN).to_grid()
    landfall.save_grid_map(floor, folder / "floor.yaml")
    scanner = landfall.make_fan(beams=360, first_rad=0.0, step_rad=math.radians(1.0))
    poses = [landfall.Pose2(1.2 + 0.3 * i, 1.1 + 0.05 * i, 0.3) for i in range(6)]
    scans = landfall.simulate(landfall.PreparedMap(floor), scanner, poses)
    for i, scan in enumerate(scans):
        scan.stamp_s, scan.T_odom_robot = float(i), poses[0].inverse() * poses[i]
    landfall.save_log(scans, folder / "drive.jsonl")
    return poses


def test_guide(tmp_path, monkeypatch):
    poses = write_files(tmp_path)
    monkeypatch.chdir(tmp_path)
    program = "\n".join(re.findall(r"```python\n(.*?)```", GUIDE.read_text(encoding="utf-8"), re.DOTALL))
    said, names = io.StringIO(), {}
    with contextlib.redirect_stdout(said):
        exec(compile(program, str(GUIDE), "exec"), names)
    assert len(names["mine"]) == 100 and names["empty"].name == "hall"
    assert names["grid"].cells.max() == 0  # all of the message's cells are 0: free
    assert len(names["track"]) == 6
    for tracked, asked, again, pose in zip(
        names["track"], names["answers"], names["again"], poses, strict=True
    ):
        for found in (tracked, asked.hypotheses[0].T_map_robot, again.hypotheses[0].T_map_robot):
            assert landfall.translation_distance(found, pose) < 0.05
    assert [stamp_s for stamp_s, _ in landfall.load_trajectory("poses.tum")] == [float(i) for i in range(6)]
    lines = said.getvalue().splitlines()
    assert lines[0].startswith("1: 1.") and lines[-2:] == ["found", "missing.yaml: no such file"]
