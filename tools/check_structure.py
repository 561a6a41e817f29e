"""Rules that no compiler holds: what a folder may include, where Embree is named, how long a file is."""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
FOLDERS = ("kernels", "raycast", "engine", "bindings", "bench", "tests")
SUFFIXES = (".hpp", ".cpp", ".h", ".c", ".py", ".pyi")
MAX_LINES = 400

# A folder may include itself and these; bench and tests may include anything.
MAY_INCLUDE = {
    "kernels": set(),
    "raycast": {"kernels"},
    "engine": {"kernels", "raycast", "landfall"},
    "bindings": {"engine", "landfall"},
}
# Of the engine's folders each may include itself and those before it: base, where to look, maps, scans,
# how a pose is refined, verified and ranked, then what is built on that. The engine's root (search.cpp,
# query.hpp) is above the first four. A map keeps the tables that methods make of it.
ENGINE_LAYERS = (
    "base",
    "priors",
    "maps",
    "scans",
    "refine",
    "verify",
    "rank",
    "sequence",
    "align",
    "scan_matching",
    "methods",
    "mapping",
)
BELOW_THE_ROOT = 4
KEPT_WITH_A_MAP = {("maps", "methods"), ("maps", "scan_matching")}
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"/]+)/(?:([^"/]+)/)?')
EMBREE_NAME = re.compile(r"\b(rtc[A-Z]\w*|RTC\w+)\b|<embree\d/")


def project_files():
    for folder in FOLDERS:
        yield from sorted(p for p in (ROOT / folder).rglob("*") if p.suffix in SUFFIXES)


def may_include(folder, other):
    return other == folder or other in MAY_INCLUDE.get(folder, {other})


def points_down(layer, other):
    """Of the engine's folders; None is its root."""
    if layer not in ENGINE_LAYERS:  # the root, or io, which stands beside them
        return True
    if other not in ENGINE_LAYERS:
        return ENGINE_LAYERS.index(layer) >= BELOW_THE_ROOT
    return ENGINE_LAYERS.index(other) <= ENGINE_LAYERS.index(layer) or (layer, other) in KEPT_WITH_A_MAP


def names_embree(path, line):
    return path.suffix in (".hpp", ".cpp") and EMBREE_NAME.search(line.split("//")[0])


def faults(path):
    name = path.relative_to(ROOT)
    folder = name.parts[0]
    layer = name.parts[1] if len(name.parts) > 2 else None
    lines = path.read_text(encoding="utf-8").splitlines()
    if len(lines) > MAX_LINES:
        yield f"{name}: {len(lines)} lines, at most {MAX_LINES} are allowed: split it"
    for number, line in enumerate(lines, start=1):
        include = INCLUDE.match(line)
        if include and include[1] in (*FOLDERS, "landfall") and not may_include(folder, include[1]):
            yield f"{name}:{number}: {folder} must not include {include[1]}"
        if include and folder == include[1] == "engine" and not points_down(layer, include[2]):
            yield f"{name}:{number}: engine/{layer} must not include engine/{include[2] or ''}"
        if folder != "raycast" and names_embree(path, line):
            yield f"{name}:{number}: Embree is named outside raycast/"


def main():
    found = [fault for path in project_files() for fault in faults(path)]
    print("\n".join(found), end="\n" if found else "")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
