"""The Google Benchmark suites as tables: kernels by instruction set, rays and searches by place, peers."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

from google_benchmark import Median, Suite, load_suite

RATES = ("bytes/s", "points/s", "blocks/s", "poses/s")
LOADS = ("load_bytes/s", "split_load_bytes/s")  # limits of the bound kernel
Table = list[list[str]]


def suite_sections(folder: Path) -> dict[str, tuple[str, Table]]:
    """Section name -> date and table, of the suites that were run."""
    tables: dict[str, Callable[[Mapping[str, Median]], Table]] = {
        "kernels": kernel_table,
        "raycast": ray_table,
        "search": search_table,
        "peers": peer_table,
        "isa": isa_table,
        "executor": executor_table,
    }
    suites = {"isa": "search", "executor": "search"}  # the others are called as their suites
    sections = {}
    for name, table in tables.items():
        path = folder / f"bench_{suites.get(name, name)}.json"
        if path.is_file():
            suite: Suite = load_suite(path)
            rows = table(suite.medians)
            if len(rows) > 1:
                sections[name] = (suite.date, rows)
    return sections


def kernel_table(medians: Mapping[str, Median]) -> Table:
    """A row per kernel, a column per instruction set; the bound kernel with its shares of the load rates."""
    kernels: dict[str, dict[str, Median]] = {}
    for name, median in medians.items():
        kernel, isa = name.rsplit("/", 1)
        kernels.setdefault(kernel, {})[isa] = median
    sets = list(dict.fromkeys(isa for of_kernel in kernels.values() for isa in of_kernel))
    rows = [["kernel", "unit", *sets]]
    for kernel, of_kernel in kernels.items():
        unit = next(unit for unit in RATES if unit in next(iter(of_kernel.values())).counters)
        rows.append([kernel, f"M {unit}", *(_rate(of_kernel.get(isa), unit) for isa in sets)])
    return rows


def _rate(median: Median | None, unit: str) -> str:
    if median is None:
        return "-"
    rate = median.counters[unit]
    limits = [median.counters[load] for load in LOADS if load in median.counters]
    shares = ", ".join(f"{100.0 * rate / limit:.0f}" for limit in limits)
    return _millions(rate) + (f" ({shares} %)" if limits else "")


def ray_table(medians: Mapping[str, Median]) -> Table:
    """M rays/s: a row per pattern and way of casting, a column per place; of several ways the one
    that the engine chooses is bold, with its share of the fastest way's rate where that is another."""
    rates: dict[tuple[str, str, str], Median] = {}
    for name, median in medians.items():
        place, pattern, way = name.split("/")
        rates[place, pattern, way] = median
    places = list(dict.fromkeys(place for place, _, _ in rates))
    rows = [["M rays/s", "way", *places]]
    for pattern in dict.fromkeys(pattern for _, pattern, _ in rates):
        for way in dict.fromkeys(way for _, of, way in rates if of == pattern):
            rows.append([pattern, way, *(_way_cell(rates, place, pattern, way) for place in places)])
    return rows


def _way_cell(rates: Mapping[tuple[str, str, str], Median], place: str, pattern: str, way: str) -> str:
    median = rates.get((place, pattern, way))
    if median is None:
        return "-"
    rate = median.counters["rays/s"]
    all_ways = [
        other.counters["rays/s"] for (at, of, _), other in rates.items() if (at, of) == (place, pattern)
    ]
    if "chosen" not in median.counters or len(all_ways) < 2:
        return _millions(rate)
    fastest = max(all_ways)
    share = f" ({100.0 * rate / fastest:.0f} % of the fastest)" if rate < fastest else ""
    return f"**{_millions(rate)}**{share}"


def search_table(medians: Mapping[str, Median]) -> Table:
    """A row per place."""
    columns: tuple[tuple[str, str, str, float], ...] = (
        ("1 thread: median ms", "branch_and_bound/threads:1", "median_ms", 1.0),
        ("2 threads: median ms", "branch_and_bound/threads:2", "median_ms", 1.0),
        ("p95 ms", "branch_and_bound/threads:2", "p95_ms", 1.0),
        ("batch, 1 thread: scans/s", "batch/threads:1", "scans/s", 1.0),
        ("2 threads: scans/s", "batch/threads:2", "scans/s", 1.0),
        ("exhaustive: M free poses/s", "exhaustive/threads:2", "poses/s", 1e-6),
        ("prepare: M cells/s", "prepare", "cells/s", 1e-6),
        ("bytes a cell", "prepare", "bytes/cell", 1.0),
    )
    places = list(dict.fromkeys(name.split("/", 1)[0] for name in medians))
    rows = [["place", *(title for title, *_ in columns)]]
    for place in places:
        cells = []
        for _, benchmark, counter, scale in columns:
            median = medians.get(f"{place}/{benchmark}/real_time")
            cells.append(f"{scale * median.counters[counter]:.1f}" if median else "-")
        rows.append([place, *cells])
    return rows


def peer_table(medians: Mapping[str, Median]) -> Table:
    """A row per place, comparison and peer; how many times faster landfall is."""
    compared: dict[str, dict[str, Median]] = {}
    for name, median in medians.items():
        what, who = name.rsplit("/", 1)
        compared.setdefault(what, {})[who] = median
    rows = [["what", "who", "unit", "peer", "landfall", "ratio"]]
    for what, by_whom in compared.items():
        ours = by_whom.pop("landfall", None)
        for who, theirs in by_whom.items() if ours else ():
            rows.append([what, who, *_side_by_side(theirs.counters, ours.counters)])
    return rows


def _side_by_side(theirs: Mapping[str, float], ours: Mapping[str, float]) -> list[str]:
    if "median_ms" in ours:
        their_ms, our_ms = theirs["median_ms"], ours["median_ms"]
        return ["ms", f"{their_ms:.1f}", f"{our_ms:.1f}", _times(their_ms / our_ms)]
    unit = next(unit for unit in ("poses/s", "rays/s") if unit in ours)
    cells = [f"{rate[unit] * 1e-6:.3g}" for rate in (theirs, ours)]
    return [f"M {unit}", *cells, _times(ours[unit] / theirs[unit])]


def _times(ratio: float) -> str:
    return f"{ratio:.0f} x" if ratio >= 100 else f"{ratio:.1f} x"


def isa_table(medians: Mapping[str, Median]) -> Table:
    """Whole searches on one thread, a row per instruction set."""
    rows = [["instruction set", "place", "median ms", "of the best"]]
    best_ms = None
    for name, median in medians.items():
        place, *what = name.split("/")
        if what[:1] != ["branch_and_bound"] or not what[1].startswith("isa:"):
            continue
        ms = median.counters["median_ms"]
        best_ms = best_ms or ms  # registered best first
        rows.append([what[1].removeprefix("isa:"), place, f"{ms:.1f}", f"{ms / best_ms:.2f}"])
    return rows


def executor_table(medians: Mapping[str, Median]) -> Table:
    """Two threads of each scheduler: a scan at a time, and a batch."""
    columns = (
        ("median ms", "branch_and_bound", "median_ms"),
        ("p95 ms", "branch_and_bound", "p95_ms"),
        ("batch: scans/s", "batch", "scans/s"),
    )
    rows = [["executor", "place", *(title for title, *_ in columns)]]
    found = dict.fromkeys(
        (name.split("/")[0], name.split("/executor:")[1].removesuffix("/real_time"))
        for name in medians
        if "/executor:" in name
    )
    for place, executor in found:
        cells = []
        for _, benchmark, counter in columns:
            median = medians.get(f"{place}/{benchmark}/threads:2/executor:{executor}/real_time")
            cells.append(f"{median.counters[counter]:.1f}" if median else "-")
        rows.append([executor, place, *cells])
    return rows


def _millions(rate: float) -> str:
    return f"{rate * 1e-6:.0f}" if rate >= 100e6 else f"{rate * 1e-6:.1f}"
