"""search(): the one entry, with maps, priors and scans given one or many."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, TypeAlias, overload

from landfall._landfall import (
    Anywhere,
    Beacons,
    CandidatePoses,
    Gaussian,
    GridMap,
    Mixture,
    PosePrior,
    PreparedMap,
    Region,
    Scan,
    SearchOptions,
    SearchResult,
    WallMap,
    Window,
    search_batch,
)
from landfall.errors import InvalidArgument, UnknownOption

if TYPE_CHECKING:
    from typing_extensions import TypedDict, Unpack

    class SearchKeywords(TypedDict, total=False):
        """The fields of SearchOptions."""

        method: str
        translation_step_m: float
        rotation_step_rad: float
        max_hypotheses: int
        time_budget_s: float
        threads: int
        seed: int
        robot_radius_m: float
        distinct_translation_m: float
        distinct_rotation_rad: float


Prior: TypeAlias = (
    PosePrior | Anywhere | Window | Gaussian | Region | Beacons | CandidatePoses | Mixture | None
)
Map: TypeAlias = PreparedMap | GridMap | WallMap

OPTION_NAMES = tuple(name for name in dir(SearchOptions) if not name.startswith("_"))


@overload
def search(
    map: Map | Sequence[Map], prior: Prior | Sequence[Prior], scans: Scan, **options: Unpack[SearchKeywords]
) -> SearchResult: ...
@overload
def search(  # type: ignore[overload-cannot-match]
    map: Map | Sequence[Map],
    prior: Prior | Sequence[Prior],
    scans: Sequence[Scan],
    **options: Unpack[SearchKeywords],
) -> list[SearchResult]: ...
def search(map, prior, scans, **options):  # type: ignore[no-untyped-def]
    """Where was the robot? results[i] answers scans[i]; a single Scan gives a single result.

    map: a PreparedMap (or a GridMap or WallMap, prepared here each time), or a list of them: hypotheses
        are then ranked across the maps, Hypothesis.map_index says which.
    prior: where to look; None is anywhere in the free space; a list holds one prior per scan.
    options, with their defaults: method ("auto"), translation_step_m (0: the map's resolution),
        rotation_step_rad (0.5 degrees), max_hypotheses (5), time_budget_s (0: none; per scan), threads
        (0: all), seed (0), robot_radius_m (0), distinct_translation_m (0.5), distinct_rotation_rad
        (10 degrees).

    The GIL is released meanwhile. A scan with no valid beam is an answer (lost), not an error. Raises
    InvalidArgument (an option, prior or scan that does not validate; a prior entirely off the map),
    UnknownName (a method), UnknownOption.
    """
    one = isinstance(scans, Scan)
    maps = [_prepared(m) for m in (map if isinstance(map, Sequence) else [map])]
    priors = [Anywhere() if p is None else p for p in (prior if isinstance(prior, Sequence) else [prior])]
    results = search_batch(maps, priors, [scans] if one else list(scans), search_options(**options))
    return results[0] if one else results


def search_options(**keywords: object) -> SearchOptions:
    """SearchOptions from keywords. Raises UnknownOption, InvalidArgument that name the keyword."""
    options = SearchOptions()
    for name, value in keywords.items():
        if name not in OPTION_NAMES:
            raise UnknownOption(f"search: unknown option '{name}'; known: {', '.join(OPTION_NAMES)}")
        try:
            setattr(options, name, value)
        except TypeError:
            expected = type(getattr(options, name)).__name__
            raise InvalidArgument(f"search: option {name} is {value!r}, expected {expected}") from None
    return options


def _prepared(map: Map) -> PreparedMap:
    return map if isinstance(map, PreparedMap) else PreparedMap(map)
