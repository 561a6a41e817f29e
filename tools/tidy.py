"""clang-tidy over the project's own sources, as many at a time as there are cores.

A file that passed is checked again only when it, a project header it reaches, its compile command, or
clang-tidy's rules change.
"""

import argparse
import hashlib
import json
import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
FOLDERS = ("kernels", "raycast", "engine", "bindings", "bench", "tests")
INCLUDE = re.compile(rb'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)
INCLUDE_FOLDERS = (ROOT, ROOT / "engine/include", ROOT / "tests", ROOT / "bindings/c")


def own_sources(build):
    commands = json.loads((build / "compile_commands.json").read_text())
    for entry in commands:
        path = Path(entry["file"])
        if path.is_relative_to(ROOT) and path.relative_to(ROOT).parts[0] in FOLDERS:
            yield path, entry["command"]


def reached_headers(path, seen):
    """The project's headers that `path` includes, directly or not; what is not found here is the system's."""
    for name in INCLUDE.findall(path.read_bytes()):
        for folder in (path.parent, *INCLUDE_FOLDERS):
            header = folder / name.decode()
            if header.is_file() and header not in seen:
                seen.add(header)
                reached_headers(header, seen)
    return seen


def rules_for(path):
    return [folder / ".clang-tidy" for folder in path.parents if (folder / ".clang-tidy").is_file()]


def key_of(path, command, version):
    digest = hashlib.sha256(version + command.encode())
    for part in sorted({path, *reached_headers(path, set()), *rules_for(path)}):
        digest.update(str(part).encode() + part.read_bytes())
    return digest.hexdigest()


def tidy(path, build):
    # The commands are gcc's: it knows warnings that clang does not.
    command = ["clang-tidy", "-quiet", "--extra-arg=-Wno-unknown-warning-option", "-p", str(build), str(path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        print(done.stdout, done.stderr if not done.stdout else "", flush=True)
    return done.returncode == 0


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", type=Path, help="a configured build folder")
    parser.add_argument("-j", "--jobs", type=int, default=os.cpu_count())
    arguments = parser.parse_args()
    build = arguments.build.resolve()
    passed = build / "tidy-passed"
    passed.mkdir(exist_ok=True)
    version = subprocess.run(["clang-tidy", "--version"], capture_output=True, check=True).stdout

    work = {path: key_of(path, command, version) for path, command in own_sources(build)}
    work = {path: key for path, key in work.items() if not (passed / key).exists()}

    def check(item):
        path, key = item
        fine = tidy(path, build)
        if fine:
            (passed / key).touch()
        return fine

    with ThreadPoolExecutor(arguments.jobs) as pool:
        results = list(pool.map(check, work.items()))
    print(f"clang-tidy: {len(results)} files checked, {results.count(False)} with findings")
    return 0 if all(results) else 1


if __name__ == "__main__":
    sys.exit(main())
