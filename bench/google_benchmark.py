"""Google Benchmark's JSON files: the median of each benchmark over its repetitions."""

from __future__ import annotations

import json
import statistics
from collections import defaultdict
from dataclasses import dataclass, field
from pathlib import Path

SECONDS = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}
OWN_FIELDS = {
    "family_index",
    "iterations",
    "cpu_time",
    "per_family_instance_index",
    "real_time",
    "repetition_index",
    "repetitions",
    "threads",
}


@dataclass(frozen=True)
class Median:
    """One benchmark: seconds an iteration, wall time where it asked for that, else processor time."""

    time_s: float
    counters: dict[str, float] = field(default_factory=dict)
    label: str = ""


@dataclass(frozen=True)
class Suite:
    """A file: when it was written, and its benchmarks by name, in the order of their registration."""

    date: str
    medians: dict[str, Median]


def load_suite(path: Path) -> Suite:
    """Raises OSError, or ValueError where this is not Google Benchmark's JSON or a benchmark failed."""
    failed = []
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
        runs: dict[str, list[dict]] = defaultdict(list)
        for entry in sorted(content["benchmarks"], key=lambda entry: entry.get("family_index", 0)):
            if entry.get("error_occurred"):
                failed.append(f"{entry['name']}: {entry.get('error_message', 'failed')}")
            elif entry.get("aggregate_name", "median") == "median":
                runs[entry.get("run_name", entry["name"])].append(entry)
        suite = Suite(content["context"]["date"], {name: _median(name, runs[name]) for name in runs})
    except (ValueError, KeyError, TypeError, AttributeError) as cause:
        raise ValueError(f"{path}: not a JSON file of Google Benchmark: {cause!r}") from None
    if failed:
        raise ValueError(f"{path}: {failed[0]}")
    return suite


def _median(name: str, entries: list[dict]) -> Median:
    """Of the repetitions; a file of aggregates has it already."""
    stated = [entry for entry in entries if "aggregate_name" in entry]
    entries = stated or entries
    time = "real_time" if name.endswith("/real_time") else "cpu_time"
    counters = [key for key, value in entries[0].items() if key not in OWN_FIELDS and _is_number(value)]
    return Median(
        statistics.median(entry[time] * SECONDS[entry["time_unit"]] for entry in entries),
        {key: statistics.median(entry[key] for entry in entries) for key in counters},
        entries[0].get("label", ""),
    )


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)
