"""slam(): maps from scans whose poses nobody knows."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from landfall._landfall import GridMap, Scan, Slam, SlamOptions, SlamStep, SwarmOptions
from landfall.errors import InvalidArgument, UnknownOption

if TYPE_CHECKING:
    from typing_extensions import TypedDict, Unpack

    class SlamKeywords(TypedDict, total=False):
        """The fields of SlamOptions."""

        matcher: str
        prediction: str
        swarm: SwarmOptions
        refine: bool
        resolution_m: float
        range_min_m: float
        range_max_m: float
        deletion_range_m: float
        least_agreement: float
        recovery_reach_m: float
        log_odds_hit: float
        log_odds_miss: float
        occupied_log_odds: float
        free_log_odds: float
        max_log_odds: float
        min_log_odds: float
        seed: int
        threads: int


OPTION_NAMES = tuple(name for name in dir(SlamOptions) if not name.startswith("_"))


@dataclass
class SlamResult:
    """steps[i] is what became of scan i; fewer than the scans where on_step ended the work."""

    steps: list[SlamStep]
    map: GridMap


def slam(
    scans: Sequence[Scan],
    on_step: Callable[[Slam, SlamStep], bool | None] | None = None,
    **options: Unpack[SlamKeywords],
) -> SlamResult:
    """Each scan matched to the map that the scans before it made; the first one's robot stands at (0, 0, 0).

    on_step: called after every scan; False from it ends the work there. options: the fields of SlamOptions.
    Raises InvalidArgument, UnknownName, UnknownOption, TooLarge.
    """
    if not scans:
        raise InvalidArgument("slam: no scans, expected at least one")
    mapping = Slam(slam_options(**options))
    steps = []
    for scan in scans:
        steps.append(mapping.add(scan))
        if on_step is not None and on_step(mapping, steps[-1]) is False:
            break
    return SlamResult(steps, mapping.map())


def slam_options(**options: Unpack[SlamKeywords]) -> SlamOptions:
    """Raises UnknownOption, UnknownName, InvalidArgument."""
    made = SlamOptions()
    for name, value in options.items():
        if name not in OPTION_NAMES:
            raise UnknownOption(f"slam: unknown option '{name}'; known: {', '.join(OPTION_NAMES)}")
        try:
            setattr(made, name, value)
        except TypeError:
            expected = type(getattr(made, name)).__name__
            raise InvalidArgument(f"slam: option {name} is {value!r}, expected {expected}") from None
    return made
