"""What landfall raises: the caller's or a file's fault, said once and completely.

The message names the file, line, field, the value found and what was expected, where they apply.
Every class is also the built-in exception that a Python user would expect.
"""

from __future__ import annotations

from typing import ClassVar


class Error(Exception):
    """Base of all; `code` says which kind, in words."""

    code: ClassVar[str] = "invalid argument"


class InvalidArgument(Error, ValueError):
    """A value given by the caller is outside what the function accepts."""


class WrongType(InvalidArgument, TypeError):
    """An argument of another type than the function takes."""


class UnknownName(Error, ValueError):
    """A method, option, sensor, place or instruction set that does not exist."""

    code = "unknown name"


class UnknownOption(UnknownName, TypeError):
    """A keyword that the function does not take."""


class FileNotFound(Error, FileNotFoundError):
    """A file is missing or cannot be opened."""

    code = "file not found"


class FileFormat(Error, ValueError):
    """A file is truncated or holds something else than its format allows."""

    code = "file format"


class FileWrite(Error, OSError):
    """A result could not be written."""

    code = "file write"


class TooLarge(Error, ValueError):
    """A size is beyond what is taken, before memory is."""

    code = "too large"


by_code: dict[str, type[Error]] = {
    kind.code: kind for kind in (InvalidArgument, UnknownName, FileNotFound, FileFormat, FileWrite, TooLarge)
}
