"""Result files: written under a temporary name, whole after every line, renamed at the end."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryFile
from typing import BinaryIO

from landfall._landfall import Pose2, save_trajectory
from landfall.errors import FileNotFound, FileWrite, InvalidArgument

PICTURE_ENDINGS = (".png", ".pdf", ".svg")


class ResultsFile:
    """results.jsonl: lines go to NAME.part; leaving the `with` block renames it, after an error too.

    Where the disk is full, flush() raises FileWrite, and the lines that are whole stay.
    """

    def __init__(self, path: Path | None) -> None:
        if path is not None:
            require_writable(path)
        self.path = None if path is None else replaceable(path)
        self.part = None if self.path is None else self.path.with_name(self.path.name + ".part")
        self._file: BinaryIO | None = None
        self._pending = bytearray()

    def __enter__(self) -> ResultsFile:
        if self.part is not None:
            self._file = _guarded(self.part, lambda part: part.open("w+b", buffering=0))
        return self

    def write(self, line: str) -> None:
        if self._file is not None:
            self._pending += line.encode() + b"\n"

    def flush(self) -> None:
        try:
            while self._pending and self._file is not None:
                del self._pending[: self._file.write(self._pending)]
        except OSError as cause:
            self._pending.clear()
            self._drop_torn_line()
            raise FileWrite(f"{self.path}: cannot be written: {cause.strerror or cause}") from cause

    def __exit__(self, *_: object) -> None:
        if self._file is None or self.part is None or self.path is None:
            return
        try:
            self.flush()
        finally:
            self._file.close()
            os.replace(self.part, self.path)

    def _drop_torn_line(self) -> None:
        """What a full disk left of the last line."""
        assert self._file is not None
        self._file.seek(0)
        self._file.truncate(self._file.read().rfind(b"\n") + 1)


def rewrite_chosen(results: Path, lines: Sequence[str], choices: Sequence[int]) -> None:
    """results.jsonl anew, each line with "chosen": the index of the consistent hypothesis, -1: none."""
    with ResultsFile(results) as chosen_lines:
        for line, choice in zip(lines, choices, strict=True):
            chosen_lines.write(f'{line[:-1]}, "chosen": {choice}}}')


def write_trajectory(poses: Sequence[tuple[float, Pose2]], tum: Path) -> None:
    """A TUM file. Raises FileNotFound, FileWrite."""
    require_writable(tum)
    save_trajectory(list(poses), tum)


def require_writable(path: Path) -> None:
    """Raises where `path` cannot become a file: said before the work, not after."""
    target = replaceable(path)
    if not target.parent.is_dir():
        raise FileNotFound(f"{path}: its folder {target.parent} does not exist")
    try:
        with TemporaryFile(dir=target.parent):
            pass
    except OSError as cause:
        raise FileWrite(f"{path}: cannot be written: {cause.strerror or cause}") from cause


def replaceable(path: Path) -> Path:
    """The file that a rename onto `path` would replace: a link's target. Raises FileWrite."""
    if path.is_dir():
        raise FileWrite(f"{path}: is a folder, expected a file to write")
    if path.exists() and not path.is_file():
        raise FileWrite(f"{path}: is a device or a pipe, expected a file to write")
    return path.resolve() if path.is_symlink() else path


def require_distinct(outputs: Mapping[str, Path | None], inputs: Iterable[Path | None] = ()) -> None:
    """Raises InvalidArgument where an output, by option, would overwrite an input or another output."""
    taken = {path.resolve(): "an input" for path in inputs if path is not None}
    for option, path in outputs.items():
        if path is None:
            continue
        if path.resolve() in taken:
            raise InvalidArgument(f"{option} {path}: would overwrite {taken[path.resolve()]}")
        taken[path.resolve()] = f"what {option} writes"


def require_picture(path: Path) -> None:
    """Raises FileNotFound, or InvalidArgument for an ending that no picture has."""
    require_writable(path)
    if path.suffix.lower() not in PICTURE_ENDINGS:
        known = ", ".join(PICTURE_ENDINGS)
        raise InvalidArgument(f"{path}: a picture ends in one of {known}, not '{path.suffix}'")


def make_folder(folder: Path) -> Path:
    """The folder, made where missing. Raises FileWrite."""
    _guarded(folder, lambda path: path.mkdir(parents=True, exist_ok=True))
    return folder


def _guarded(path: Path, action: Callable):
    try:
        return action(path)
    except OSError as cause:
        raise FileWrite(f"{path}: cannot be written: {cause.strerror or cause}") from cause
