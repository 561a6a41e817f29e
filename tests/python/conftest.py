"""A small building, a log of it, and the real data where it is."""

from __future__ import annotations

import math
import os
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import landfall
import pytest
from landfall.cli import main

# Two rooms of different shape, a passage between them, a pillar: nothing looks the same from two places.
PLAN = [
    [0, 0, 8, 0],
    [8, 0, 8, 5],
    [8, 5, 5, 5],
    [5, 5, 5, 3],
    [5, 3, 4.6, 3],
    [4.6, 3, 4.6, 4.2],
    [4.6, 4.2, 0, 3.4],
    [0, 3.4, 0, 0],
    [3, 0, 3, 1.2],
    [6.5, 1.5, 6.9, 1.5],
    [6.9, 1.5, 6.9, 1.9],
    [6.9, 1.9, 6.5, 1.9],
    [6.5, 1.9, 6.5, 1.5],
]
POSES = [landfall.Pose2(0.8 + 0.45 * i, 2.2, 0.3 * math.sin(i)) for i in range(12)]


@dataclass(frozen=True)
class Command:
    """What a run of `landfall` left."""

    code: int
    out: str
    err: str

    def fails_with(self, *words: str) -> None:
        """Exit code 2 and one line on stderr that holds every word."""
        lines = self.err.splitlines()
        assert self.code == 2, self.err
        assert len(lines) == 1 and lines[0].startswith("landfall: "), self.err
        missing = [word for word in words if word not in lines[0]]
        assert not missing, f"{missing} not in: {lines[0]}"


@pytest.fixture
def landfall_command(capsys: pytest.CaptureFixture[str]) -> Callable[..., Command]:
    """Runs the command inside this process."""

    def run(*arguments: object) -> Command:
        capsys.readouterr()
        code = main([str(argument) for argument in arguments])
        captured = capsys.readouterr()
        return Command(code, captured.out, captured.err)

    return run


def landfall_process(*arguments: object, cwd: Path) -> subprocess.Popen[str]:
    """Starts the command as a process of its own."""
    return subprocess.Popen(
        [sys.executable, "-m", "landfall", *map(str, arguments)],
        cwd=cwd,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


@pytest.fixture(scope="session")
def plan() -> landfall.WallMap:
    return landfall.WallMap(PLAN)


@pytest.fixture(scope="session")
def grid(plan: landfall.WallMap) -> landfall.GridMap:
    return plan.to_grid(resolution_m=0.05, outside_unknown=True)


@pytest.fixture(scope="session")
def prepared(grid: landfall.GridMap) -> landfall.PreparedMap:
    return landfall.PreparedMap(grid, name="small")


@pytest.fixture(scope="session")
def laser() -> landfall.Sensor:
    return landfall.make_fan(181, -math.pi / 2, math.radians(1.0), range_max_m=20.0, range_noise_m=0.005)


@pytest.fixture
def scans(plan: landfall.WallMap, laser: landfall.Sensor) -> list[landfall.Scan]:
    """A short drive with exact odometry, one scan a second."""
    made = landfall.simulate(landfall.PreparedMap(plan), laser, POSES, seed=1)
    for i, scan in enumerate(made):
        scan.stamp_s = 100.0 + i
        scan.T_odom_robot = POSES[0].inverse() * POSES[i]
    return made


@dataclass(frozen=True)
class Files:
    """The small building and its drive on disk."""

    folder: Path
    map: Path
    log: Path
    truth: Path
    sensor: Path


@pytest.fixture
def files(
    tmp_path: Path, grid: landfall.GridMap, scans: list[landfall.Scan], laser: landfall.Sensor
) -> Files:
    found = Files(
        tmp_path,
        tmp_path / "floor.yaml",
        tmp_path / "drive.jsonl",
        tmp_path / "truth.tum",
        tmp_path / "laser.yaml",
    )
    landfall.save_grid_map(grid, found.map)
    landfall.save_trajectory(
        [(scan.stamp_s, pose) for scan, pose in zip(scans, POSES, strict=True)], found.truth
    )
    landfall.save_sensor(laser, found.sensor)
    for scan in scans:
        scan.T_map_robot = None
    landfall.save_log(scans, found.log)
    return found


@pytest.fixture(scope="session")
def data() -> Path:
    """Real maps and logs."""
    default = Path(__file__).resolve().parents[2].parent / "shared" / "data"
    folder = Path(os.environ.get("LANDFALL_DATA", default))
    if not (folder / "intel" / "map.yaml").exists():
        pytest.skip(f"no real data in {folder}: set LANDFALL_DATA")
    return folder
