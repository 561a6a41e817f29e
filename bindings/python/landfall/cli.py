"""The `landfall` command: one file per subcommand in landfall/commands/."""

from __future__ import annotations

import itertools
import os
import re
import sys
from collections.abc import Sequence
from typing import Annotated

import typer

from landfall import __version__
from landfall.commands import convert, demo, evaluate, map, methods, relocalize, reproduce, search, simulate
from landfall.errors import Error

try:
    from typer import TyperException as UsageProblem
except ImportError:  # Typer before it brought its own Click
    from click import ClickException as UsageProblem  # type: ignore[assignment, no-redef]

PLAINER = {  # what Typer says of values
    "Input should be a valid integer, unable to parse string as an integer": "expected a whole number",
    "Input should be a valid number, unable to parse string as a number": "expected a number",
    "Input should be ": "expected a number ",
}

app = typer.Typer(
    help="Global relocalization from range scans and a known map.",
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    context_settings={"help_option_names": ["-h", "--help"]},
)
for command in (demo, relocalize, search, map, simulate, evaluate, convert, methods, reproduce):
    name = command.__name__.rsplit(".", 1)[-1]
    summary = " ".join((command.run.__doc__ or "").split("\n\n")[0].split())
    app.command(name, short_help=summary)(command.run)


def _print_version(wanted: bool) -> None:
    if wanted:
        print(f"landfall {__version__}")
        raise typer.Exit


@app.callback()
def _options(
    version: Annotated[
        bool, typer.Option("--version", callback=_print_version, is_eager=True, help="Print it and leave.")
    ] = False,
) -> None:
    pass


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command. The caller's or a file's fault is one line on stderr and exit code 2."""
    given = list(sys.argv[1:] if arguments is None else arguments) or ["--help"]
    try:
        return app(args=given, prog_name="landfall", standalone_mode=False) or 0
    except UsageProblem as problem:
        return _complain(_with_value(problem.format_message(), given))
    except Error as error:
        return _complain(str(error))
    except (KeyboardInterrupt, typer.Abort):
        return 130
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # silences the flush at exit
        return 1
    except OSError as cause:  # a full disk, say
        return _complain(str(cause))


def _with_value(message: str, given: Sequence[str]) -> str:
    """Click's "Invalid value for '--every': ..." with the value that was given."""
    match = re.match(r"Invalid value for '(--[\w-]+)': (.*)", message, re.DOTALL)
    if match is None:
        return message
    option, rest = match.groups()
    values = [b for a, b in itertools.pairwise(given) if a == option]
    values += [word.removeprefix(f"{option}=") for word in given if word.startswith(f"{option}=")]
    for theirs, ours in PLAINER.items():
        rest = rest.replace(theirs, ours)
    return f"{option} {' '.join(values)}: {rest}"


def _complain(message: str) -> int:
    print("landfall: " + " ".join(message.split()), file=sys.stderr)
    return 2
