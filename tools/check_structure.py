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
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"/]+)/')
EMBREE_NAME = re.compile(r"\b(rtc[A-Z]\w*|RTC\w+)\b|<embree\d/")


def project_files():
    for folder in FOLDERS:
        yield from sorted(p for p in (ROOT / folder).rglob("*") if p.suffix in SUFFIXES)


def may_include(folder, other):
    return other == folder or other in MAY_INCLUDE.get(folder, {other})


def names_embree(path, line):
    return path.suffix in (".hpp", ".cpp") and EMBREE_NAME.search(line.split("//")[0])


def faults(path):
    name = path.relative_to(ROOT)
    folder = name.parts[0]
    lines = path.read_text(encoding="utf-8").splitlines()
    if len(lines) > MAX_LINES:
        yield f"{name}: {len(lines)} lines, at most {MAX_LINES} are allowed: split it"
    for number, line in enumerate(lines, start=1):
        include = INCLUDE.match(line)
        if include and include[1] in (*FOLDERS, "landfall") and not may_include(folder, include[1]):
            yield f"{name}:{number}: {folder} must not include {include[1]}"
        if folder != "raycast" and names_embree(path, line):
            yield f"{name}:{number}: Embree is named outside raycast/"


def main():
    found = [fault for path in project_files() for fault in faults(path)]
    print("\n".join(found), end="\n" if found else "")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
