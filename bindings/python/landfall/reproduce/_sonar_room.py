"""Made-up rooms of 9 x 6 m, and an AmigoBot's eight sonars read during a turn on the spot."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from landfall._landfall import Beam, GridMap, Pose2, PreparedMap, Scan, Sensor, WallMap, simulate_ranges

CELL_M = 0.1
GRID_CELLS = 128
ROOM_M = (1.85, 3.35, 10.95, 9.45)  # x0, y0, x1, y1: in the middle of the grid
# The paper's test points, decimetres in its matrices.
TEST_POINTS = {"A": (4.710, 6.748), "B": (6.211, 6.748), "C": (7.705, 6.748)}
CLEARANCE_M = 0.4  # of a robot's centre to the nearest wall
TURNS = 32

# x, y in metres, direction in degrees: the paper's eight, where AmigoBot carries them.
SONARS = (
    (0.076, 0.100, 90),
    (0.125, 0.075, 44),
    (0.150, 0.030, 12),
    (0.150, -0.030, -12),
    (0.125, -0.075, -44),
    (0.076, -0.100, -90),
    (-0.140, 0.058, 144),
    (-0.140, -0.058, -144),
)
HALF_ANGLE_RAD = math.radians(15.0)
RANGE_MIN_M, RANGE_MAX_M = 0.1, 5.0
NOISE_M, NOISE_RELATIVE = 0.01, 0.01
# From this incidence on the sound is reflected away rather than back.
OBLIQUE_RAD = math.radians(3.0)
MOST_EXCESS = 0.3

Box = tuple[float, float, float, float]


@dataclass
class Room:
    """What the robot has of it, and what its sonars meet."""

    map: PreparedMap  # cells of 1 dm, occupied where a wall runs through them
    walls: PreparedMap  # the walls themselves, anywhere between the cells' edges


def make_room(seed: int) -> Room:
    """Four walls and furniture along them, different on each side; on the paper's grid of 128 x 128 cells."""
    rng = np.random.default_rng([seed, 1])
    boxes: list[Box] = []
    for side in (0, 1, 2, 3, *rng.integers(0, 4, size=int(rng.integers(1, 4)))):
        box = _box_along(int(side), rng)
        if all(_distance(box, point) > 0.5 for point in TEST_POINTS.values()):
            boxes.append(box)
    return Room(PreparedMap(_grid(boxes), field_sigma_m=CELL_M), PreparedMap(_walls(boxes)))


def _box_along(side: int, rng: np.random.Generator) -> Box:
    """Against wall `side` (0: lower, 1: upper, 2: left, 3: right), anywhere along it."""
    x0, y0, x1, y1 = ROOM_M
    along, deep = rng.uniform(0.5, 2.2), rng.uniform(0.3, 1.3)
    if side < 2:
        x = rng.uniform(x0, x1 - along)
        return (x, y0, x + along, y0 + deep) if side == 0 else (x, y1 - deep, x + along, y1)
    y = rng.uniform(y0, y1 - along)
    return (x0, y, x0 + deep, y + along) if side == 2 else (x1 - deep, y, x1, y + along)


def _walls(boxes: Sequence[Box]) -> WallMap:
    """All sides of room and furniture; what is inside of furniture no sonar reaches."""
    sides = [
        side
        for x0, y0, x1, y1 in (ROOM_M, *boxes)
        for side in ((x0, y0, x1, y0), (x1, y0, x1, y1), (x1, y1, x0, y1), (x0, y1, x0, y0))
    ]
    return WallMap(np.array(sides))


def _grid(boxes: Sequence[Box]) -> GridMap:
    """Free in the room, unknown outside and inside of furniture; the faces that can be seen occupied."""
    center = (np.arange(GRID_CELLS) + 0.5) * CELL_M
    x, y = np.meshgrid(center, center)
    cells = np.full((GRID_CELLS, GRID_CELLS), 2, np.uint8)
    cells[_inside(ROOM_M, x, y)] = 0
    for box in boxes:
        cells[_inside(box, x, y)] = 2
    for box in (ROOM_M, *boxes):
        col0, row0, col1, row1 = (math.floor(side_m / CELL_M) for side_m in box)
        cells[row0 : row1 + 1, [col0, col1]] = 1
        cells[[row0, row1], col0 : col1 + 1] = 1
    cells[(cells == 1) & ~_beside_free(cells)] = 2
    return GridMap(cells, CELL_M, (0.0, 0.0, 0.0))


def _beside_free(cells: np.ndarray) -> np.ndarray:
    """Cells with a free one among their eight neighbours: of walls, those that a robot may see."""
    free = np.pad(cells == 0, 1)
    height, width = cells.shape
    shifted = [free[dy : dy + height, dx : dx + width] for dy in range(3) for dx in range(3)]
    return np.logical_or.reduce(shifted)


def _inside(box: Box, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    return (box[0] < x) & (x < box[2]) & (box[1] < y) & (y < box[3])


def _distance(box: Box, point: tuple[float, float]) -> float:
    dx = max(box[0] - point[0], 0.0, point[0] - box[2])
    dy = max(box[1] - point[1], 0.0, point[1] - box[3])
    return math.hypot(dx, dy)


def random_poses(map: PreparedMap, count: int, seed: int) -> list[Pose2]:
    """Anywhere in the room with room to turn, at any heading."""
    rng = np.random.default_rng([seed, 2])
    clear_cells = (CLEARANCE_M / CELL_M) ** 2
    free = (map.grid.cells == 0) & (map.squared_distance_cells() > clear_cells)
    rows, cols = np.nonzero(free)
    poses = []
    for k in rng.choice(len(rows), size=count):
        x, y = (np.array([cols[k], rows[k]]) + rng.uniform(0.0, 1.0, 2)) * CELL_M
        poses.append(Pose2(float(x), float(y), float(rng.uniform(-math.pi, math.pi))))
    return poses


def amigobot(half_angle_rad: float = HALF_ANGLE_RAD) -> Sensor:
    """The eight sonars with cones of this half-angle."""
    beams = [
        Beam((x, y, math.radians(direction)), half_angle_rad, RANGE_MIN_M, RANGE_MAX_M)
        for x, y, direction in SONARS
    ]
    return Sensor(beams, "amigobot", range_noise_m=NOISE_M, range_noise_relative=NOISE_RELATIVE)


def read_turn(
    walls: PreparedMap, T_map_robot: Pose2, seed: int, most_excess: float = MOST_EXCESS
) -> list[Scan]:
    """The sonars' readings at TURNS headings, a full turn from T_map_robot on.

    A sonar returns the nearest obstacle in its cone where the sound meets it head on (or at a corner), with
    noise. Where that obstacle lies at the cone's rim the sound meets it at a slant and is reflected away: the
    reading is that along the beam's axis, or longer by anything up to `most_excess` of it.
    """
    rng = np.random.default_rng([seed, 3])
    step_rad = 2.0 * math.pi / TURNS
    poses = [
        Pose2(T_map_robot.x_m, T_map_robot.y_m, T_map_robot.theta_rad + k * step_rad) for k in range(TURNS)
    ]
    nearest = simulate_ranges(walls, amigobot(), poses).astype(float)
    axis = simulate_ranges(walls, amigobot(0.0), poses).astype(float)
    long = np.maximum(nearest, axis) * (1.0 + most_excess * rng.uniform(size=axis.shape))
    ranges = np.where(_incidence_rad(walls, poses, nearest) > OBLIQUE_RAD, long, nearest)
    ranges += (NOISE_M + NOISE_RELATIVE * np.where(np.isfinite(ranges), ranges, 0.0)) * rng.normal(
        size=ranges.shape
    )
    sensor = amigobot()
    return [Scan(sensor, np.minimum(row, RANGE_MAX_M).astype(np.float32)) for row in ranges]


def _incidence_rad(walls: PreparedMap, poses: list[Pose2], nearest: np.ndarray) -> np.ndarray:
    """At the nearest point of each cone, by how much less a slightly wider cone returns: 0 head on."""
    wider_rad = math.radians(0.5)
    wider = simulate_ranges(walls, amigobot(HALF_ANGLE_RAD + wider_rad), poses).astype(float)
    with np.errstate(invalid="ignore"):
        slope = (nearest - wider) / (wider_rad * nearest)
    return np.where(np.isfinite(slope), np.arctan(np.maximum(slope, 0.0)), 0.0)
