"""The maps that sonar readings are made into, side by side."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from landfall._landfall import (
    GridMap,
    Scan,
    correct_to_bounding_box,
    map_by_triangulation,
    map_from_sonars,
    map_of_end_points,
)


def _raw_box(scans: list[Scan]) -> GridMap:
    return map_of_end_points([correct_to_bounding_box(scan) for scan in scans])


MAKERS: dict[str, Callable[[list[Scan]], GridMap]] = {
    "raw": map_of_end_points,
    "elfes": map_from_sonars,
    "tbf": lambda scans: map_by_triangulation(scans).map,
    "tbf_box": lambda scans: map_by_triangulation(scans, bounding_box=True).map,
    "raw_box": _raw_box,
    "tbf_connected": lambda scans: map_by_triangulation(scans, connect_walls=True).map,
    "tbf_box_connected": lambda scans: map_by_triangulation(scans, bounding_box=True, connect_walls=True).map,
    "tbf_box_echoes": lambda scans: (
        map_by_triangulation(scans, bounding_box=True, box_corrects_no_echo=False).map
    ),
}
LABELS = {
    "raw": "raw end points",
    "elfes": "Elfes grid",
    "tbf": "TBF",
    "tbf_box": "TBF + bounding box",
    "raw_box": "raw end points, corrected by the box",
    "tbf_connected": "TBF, walls connected (section 6)",
    "tbf_box_connected": "TBF + bounding box, walls connected",
    "tbf_box_echoes": "TBF + box that leaves readings without echo",
}
FOUR = ("raw", "elfes", "tbf", "tbf_box")


def make_maps(scans: Sequence[Scan], names: Sequence[str] = tuple(MAKERS)) -> dict[str, GridMap]:
    """From scans whose T_map_robot is set."""
    return {name: MAKERS[name](list(scans)) for name in names}
