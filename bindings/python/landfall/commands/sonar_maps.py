"""Maps from sonars, as `landfall map` makes them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from landfall._landfall import GridMap, Scan, map_by_triangulation, map_from_sonars, map_of_end_points


@dataclass
class SonarSettings:
    """What the command's options say of maps from sonars."""

    resolution_m: float
    window_scans: int
    bounding_box: bool
    connect_walls: bool


def by_triangulation(scans: Sequence[Scan], settings: SonarSettings) -> GridMap:
    return map_by_triangulation(
        scans,
        resolution_m=settings.resolution_m,
        window_scans=settings.window_scans,
        bounding_box=settings.bounding_box,
        connect_walls=settings.connect_walls,
    ).map


def by_cones(scans: Sequence[Scan], settings: SonarSettings) -> GridMap:
    return map_from_sonars(scans, resolution_m=settings.resolution_m)


def by_end_points(scans: Sequence[Scan], settings: SonarSettings) -> GridMap:
    return map_of_end_points(scans, resolution_m=settings.resolution_m)


SONAR_METHODS = {"tbf": by_triangulation, "sonar-grid": by_cones, "end-points": by_end_points}
