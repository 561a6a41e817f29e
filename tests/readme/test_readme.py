"""The README's Python program, taken out of it and run beside a map and a log made for it."""

import math
import re
import subprocess
import sys
from pathlib import Path

import landfall

README = Path(__file__).resolve().parents[2] / "README.md"
PLAN = [[0, 0, 6, 0], [6, 0, 6, 4], [6, 4, 2, 4], [2, 4, 0, 3], [0, 3, 0, 0]]


def write_files(folder):
    """floor.yaml and drive.jsonl: what the README's programs read."""
    floor = landfall.WallMap(PLAN).to_grid()
    landfall.save_grid_map(floor, folder / "floor.yaml")
    scanner = landfall.make_fan(beams=360, first_rad=0.0, step_rad=math.radians(1.0))
    poses = [landfall.Pose2(1.5, 1.1, 0.3), landfall.Pose2(2.5, 1.1, 0.3)]
    landfall.save_log(landfall.simulate(landfall.PreparedMap(floor), scanner, poses), folder / "drive.jsonl")


def test_python_program(tmp_path):
    (program,) = re.findall(r"```python\n(.*?)```", README.read_text(encoding="utf-8"), re.DOTALL)
    write_files(tmp_path)
    done = subprocess.run(
        [sys.executable, "-c", program], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    lines = done.stdout.splitlines()
    assert len(lines) == 2
    assert all(line.startswith("found: ") for line in lines)


def test_commands_exist():
    readme = README.read_text(encoding="utf-8")
    commands = re.findall(r"^    landfall (\w+)  ", readme, re.MULTILINE)
    assert "relocalize" in commands
    for command in commands:
        done = subprocess.run(
            [Path(sys.executable).parent / "landfall", command, "--help"],
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, f"landfall {command} --help: {done.stderr}"
