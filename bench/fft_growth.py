"""How a heading of method fft grows with the map: docs/fft_growth.png from bench_fft's JSON of each build.

build/bench/bench/bench_fft --benchmark_filter=cost_model/transform --benchmark_out=fftw.json
bench/fft_growth.py fftw.json eigen.json
"""

from __future__ import annotations

import json
import math
import os
import sys
from pathlib import Path

PICTURE = Path(__file__).resolve().parent.parent / "docs" / "fft_growth.png"
PREFIX = "cost_model/transform/"


def load_headings(path: Path) -> tuple[str, dict[int, float]]:
    """The library, and milliseconds of a heading by the transforms' side. Raises OSError, ValueError."""
    suite = json.loads(path.read_text(encoding="utf-8"))
    times: dict[int, list[float]] = {}
    for run in suite["benchmarks"]:
        if run["run_type"] == "iteration" and run["name"].startswith(PREFIX):
            side = int(run["name"].removeprefix(PREFIX).split("/")[0])
            times.setdefault(side, []).append(run["cpu_time"])
    if not times:
        raise ValueError(f"{path}: no {PREFIX}*, expected bench_fft's JSON with single repetitions")
    return suite["context"]["transforms"], {side: sorted(t)[len(t) // 2] for side, t in times.items()}


def draw_headings(found: dict[str, dict[int, float]], path: Path) -> None:
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots(figsize=(6.4, 4.4), layout="constrained")
    for library, times in found.items():
        axes.plot(list(times), list(times.values()), "o-", label=library)
    side0, ms0 = next(iter(next(iter(found.values())).items()))
    sides = [128, 4096]
    levels = [side * side * math.log2(side) for side in sides]
    first = side0 * side0 * math.log2(side0)
    axes.plot(sides, [ms0 * level / first for level in levels], "--", color="0.5", label="n² log n")
    axes.set(xscale="log", yscale="log", xlabel="cells along a side of the transforms, n")
    axes.set(ylabel="ms of one thread", title="all translations at one heading: n x n")
    axes.set_xticks([128, 256, 512, 1024, 2048, 4096], ["128", "256", "512", "1024", "2048", "4096"])
    axes.minorticks_off()
    axes.grid(alpha=0.4)
    axes.legend()
    part = path.with_name(path.name + ".part")
    figure.savefig(part, format="png", dpi=100)
    plt.close(figure)
    os.replace(part, path)


def main(arguments: list[str]) -> int:
    try:
        found = dict(load_headings(Path(argument)) for argument in arguments)
        if not found:
            raise ValueError("expected JSON files of bench_fft")
        draw_headings(found, PICTURE)
    except (OSError, ValueError, KeyError) as cause:
        print(f"fft_growth: {cause}", file=sys.stderr)
        return 2
    for library, times in found.items():
        print(library, ", ".join(f"{side}: {ms:.2f} ms" for side, ms in times.items()))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
