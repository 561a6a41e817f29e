"""Two JSON files of Google Benchmark side by side: medians, their ratio, and a mark on what got slower.

Exit code 1 where something got slower by more than 10 %, 2 where a file cannot be read.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from pathlib import Path

from google_benchmark import Median, load_suite

TOLERATED = 1.10


def lines(old: dict[str, Median], new: dict[str, Median]) -> Iterator[tuple[str, bool]]:
    """A line per benchmark of either file, and whether it got slower."""
    width = max((len(name) for name in {*old, *new}), default=0)
    for name in [*old, *(name for name in new if name not in old)]:
        if name not in old or name not in new:
            yield f"{name:{width}}  only in the {'old' if name in old else 'new'} file", False
            continue
        before_s, after_s = old[name].time_s, new[name].time_s
        ratio = after_s / before_s if before_s > 0 else float("inf")
        slower = ratio > TOLERATED
        mark = "  slower" if slower else "  faster" if ratio < 1 / TOLERATED else ""
        yield f"{name:{width}}  {_time(before_s)} {_time(after_s)}  {ratio:6.3f}{mark}", slower


def _time(seconds: float) -> str:
    for unit, scale in (("s ", 1.0), ("ms", 1e3), ("us", 1e6)):
        if seconds * scale >= 1.0:
            return f"{seconds * scale:9.3f} {unit}"
    return f"{seconds * 1e9:9.3f} ns"


def main(arguments: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(prog="tools/compare_bench", description=__doc__)
    parser.add_argument("old", type=Path)
    parser.add_argument("new", type=Path)
    files = parser.parse_args(arguments)
    try:
        old, new = load_suite(files.old), load_suite(files.new)
    except (OSError, ValueError) as cause:
        print(f"compare_bench: {cause}", file=sys.stderr)
        return 2
    compared = list(lines(old.medians, new.medians))
    print("\n".join(line for line, _ in compared))
    regressions = sum(slower for _, slower in compared)
    print(f"{regressions} of {len(compared)} slower by more than {100 * (TOLERATED - 1):.0f} %")
    return 1 if regressions else 0


if __name__ == "__main__":
    sys.exit(main())
