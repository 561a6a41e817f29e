"""clang-tidy over the project's own sources, as many at a time as there are cores.

Most of clang-tidy's time goes to the headers that a source includes. Sources compiled alike, of one folder's
rules and without equal names, are therefore checked together, as if one file included them all; each is
checked alone where that does not compile.

A file that passed is checked again only when it, a project header it reaches, its compile command, or
clang-tidy's rules change.
"""

import argparse
import hashlib
import json
import os
import re
import shlex
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
FOLDERS = ("kernels", "raycast", "engine", "bindings", "bench", "tests")
INCLUDE = re.compile(rb'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)
INCLUDE_FOLDERS = (ROOT, ROOT / "engine/include", ROOT / "tests", ROOT / "bindings/c")
TOGETHER = 8
# What a line that begins a declaration declares, roughly.
TYPE = re.compile(r"(?:template.*> )?(?:struct|class|enum class) (\w+)")
OTHER = re.compile(
    r"(?!namespace|using|TEST|INSTANTIATE|extern)[A-Za-z].*?(?<!:)\b(?!const\b|noexcept\b)([A-Za-z_]\w*)\s*[({=;\[]"
)
# Highway includes such a file again for each instruction set; C is another language; main is defined once.
ALONE = re.compile(r"foreach_target|\bint main\(|\bTEST_MAIN\b|LLVMFuzzer")


@dataclass
class Group:
    """Sources to check together, and what they declare."""

    paths: list = field(default_factory=list)
    names: set = field(default_factory=set)


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


def flags_of(path, command):
    """Without compiler, input and output."""
    words = shlex.split(command)[1:]
    output = words.index("-o") + 1 if "-o" in words else len(words)
    return tuple(
        word for at, word in enumerate(words) if at != output and word not in ("-o", "-c", str(path))
    )


def declared_names(text):
    lines = text.splitlines()
    return {found[1] for line in lines if (found := TYPE.match(line) or OTHER.match(line))}


def groups_of(commands):
    """Lists of sources; those in one list compile as one, as far as can be told without compiling."""
    groups = {}
    for path, command in sorted(commands.items()):
        text = path.read_text()
        if path.suffix == ".c" or ALONE.search(text):
            groups[path] = [Group([path])]
            continue
        alike = groups.setdefault((tuple(rules_for(path)), flags_of(path, command)), [])
        names = declared_names(text)
        for group in alike:
            if len(group.paths) < TOGETHER and group.names.isdisjoint(names):
                break
        else:
            group = Group()
            alike.append(group)
        group.paths.append(path)
        group.names |= names
    return [group.paths for alike in groups.values() for group in alike]


def tidy(path, build):
    # The commands are gcc's: it knows warnings that clang does not.
    done = run("-p", str(build), "--extra-arg=-Wno-unknown-warning-option", str(path))
    if done.returncode != 0:
        print(done.stdout, done.stderr if not done.stdout else "", flush=True)
    return done.returncode == 0


def tidy_together(paths, flags, scratch):
    """A file that includes them all, laid over the folder whose rules they share."""
    folder = rules_for(paths[0])[0].parent
    name = f"tidy_{hashlib.sha256(str(paths).encode()).hexdigest()[:12]}.cpp"
    content, overlay = scratch / name, scratch / f"{name}.json"
    content.write_text("".join(f'#include "{path}"\n' for path in paths))
    entry = {"name": name, "type": "file", "external-contents": str(content)}
    root = {"name": str(folder), "type": "directory", "contents": [entry]}
    overlay.write_text(json.dumps({"version": 0, "roots": [root]}))
    return run(
        f"--vfsoverlay={overlay}",
        "--checks=-bugprone-suspicious-include",
        f"--header-filter=/({'|'.join(FOLDERS)})/.*",
        str(folder / name),
        "--",
        *flags,
        "-Wno-unknown-warning-option",
    )


def run(*arguments):
    return subprocess.run(["clang-tidy", "-quiet", *arguments], capture_output=True, text=True, check=False)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", type=Path, help="a configured build folder")
    parser.add_argument("-j", "--jobs", type=int, default=os.cpu_count())
    arguments = parser.parse_args()
    build = arguments.build.resolve()
    passed = build / "tidy-passed"
    passed.mkdir(exist_ok=True)
    version = subprocess.run(["clang-tidy", "--version"], capture_output=True, check=True).stdout

    commands = dict(own_sources(build))
    keys = {path: key_of(path, command, version) for path, command in commands.items()}
    due = {path: command for path, command in commands.items() if not (passed / keys[path]).exists()}

    def check(paths):
        """Of each path, whether it passed; what one alone would not have is not held against it."""
        together = (
            len(paths) > 1 and not tidy_together(paths, flags_of(paths[0], due[paths[0]]), scratch).returncode
        )
        fine = [together or tidy(path, build) for path in paths]
        for path, passes in zip(paths, fine, strict=True):
            if passes:
                (passed / keys[path]).touch()
        return fine

    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(arguments.jobs) as pool:
        scratch = Path(folder)
        results = [fine for checked in pool.map(check, groups_of(due)) for fine in checked]
    print(f"clang-tidy: {len(results)} files checked, {results.count(False)} with findings")
    return 0 if all(results) else 1


if __name__ == "__main__":
    sys.exit(main())
