"""Furnished rooms on a grid, little cluttered, as a wheelchair's sonars see them."""

from __future__ import annotations

import numpy as np

from landfall._landfall import GridMap

RESOLUTION_M = 0.1
WALL_CELLS = 3
FREE, OCCUPIED = 0, 1


def make_room(rng: np.random.Generator) -> GridMap:
    """4 to 6 m by 3.5 to 5 m within thick walls; cupboards along the walls, an alcove, a table or two."""
    width, height = int(rng.integers(40, 61)), int(rng.integers(35, 51))
    cells = np.full((height + 2 * WALL_CELLS, width + 2 * WALL_CELLS), OCCUPIED, dtype=np.uint8)
    room = cells[WALL_CELLS:-WALL_CELLS, WALL_CELLS:-WALL_CELLS]
    room[:] = FREE
    _projection(rng, room)
    for _ in range(int(rng.integers(3, 6))):
        _cupboard(rng, room)
    for _ in range(int(rng.integers(1, 3))):
        _table(rng, room)
    return GridMap(cells, RESOLUTION_M)


def _projection(rng: np.random.Generator, room: np.ndarray) -> None:
    """A corner that is built in: the room is no rectangle."""
    rows, cols = int(rng.integers(8, 16)), int(rng.integers(8, 20))
    top, right = rng.random(2) < 0.5
    room[slice(-rows, None) if top else slice(0, rows), slice(-cols, None) if right else slice(0, cols)] = (
        OCCUPIED
    )


def _cupboard(rng: np.random.Generator, room: np.ndarray) -> None:
    """A block with its back to one of the walls."""
    along, depth = int(rng.integers(6, 21)), int(rng.integers(4, 9))
    side = room if rng.random() < 0.5 else room.T
    start = int(rng.integers(0, side.shape[1] - along))
    side[slice(0, depth) if rng.random() < 0.5 else slice(-depth, None), start : start + along] = OCCUPIED


def _table(rng: np.random.Generator, room: np.ndarray) -> None:
    """A block that stands free."""
    rows, cols = rng.integers(5, 13, 2)
    row = int(rng.integers(10, max(11, room.shape[0] - rows - 10)))
    col = int(rng.integers(10, max(11, room.shape[1] - cols - 10)))
    room[row : row + rows, col : col + cols] = OCCUPIED
