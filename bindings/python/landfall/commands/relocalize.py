"""landfall relocalize: a pose per scan of a log."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated

import typer

from landfall._landfall import Log, Scan
from landfall.commands.options import (
    LogFile,
    Maps,
    MaxHypotheses,
    Method,
    PriorText,
    RobotRadius,
    RotationStep,
    Seed,
    SensorFile,
    Threads,
    TimeBudget,
    TranslationStep,
    load_maps,
    naming_prior,
    read_log,
    read_prior,
    rotation_step_rad,
)
from landfall.commands.tables import print_table
from landfall.errors import Error, InvalidArgument
from landfall.interrupts import CleanStop
from landfall.outputs import (
    ResultsFile,
    make_folder,
    require_distinct,
    require_picture,
    require_writable,
    rewrite_chosen,
    write_trajectory,
)
from landfall.progress import progress_bar
from landfall.relocalization import CONSISTENT_HYPOTHESES, Answers, Question, Tally, relocalize, tie_together
from landfall.searching import search_options
from landfall.windows import (
    Composition,
    Query,
    odometry,
    scan_windows,
    single_queries,
    time_windows,
    with_motion,
)


def run(
    map: Maps,
    log: LogFile,
    out: Annotated[Path | None, typer.Option("--out", help="TUM trajectory of the best poses.")] = None,
    results: Annotated[
        Path | None, typer.Option("--results", help="results.jsonl: a line per query.")
    ] = None,
    picture: Annotated[Path | None, typer.Option("--picture", help="Draw all best poses here.")] = None,
    pictures: Annotated[int, typer.Option("--pictures", min=0, help="Draw so many single answers.")] = 0,
    pictures_dir: Annotated[
        Path | None, typer.Option("--pictures-dir", help="Folder of --pictures; by default beside --out.")
    ] = None,
    method: Method = "auto",
    prior: PriorText = "anywhere",
    every: Annotated[int, typer.Option("--every", min=1, help="Every n-th scan or window.")] = 1,
    limit: Annotated[int | None, typer.Option("--limit", min=1, help="At most so many queries.")] = None,
    window_scans: Annotated[
        int | None, typer.Option("--window-scans", min=1, help="Ask windows of n scans, aligned and merged.")
    ] = None,
    window_s: Annotated[
        float | None, typer.Option("--window-s", help="Ask windows of so many seconds.")
    ] = None,
    window_max_scans: Annotated[
        int, typer.Option("--window-max-scans", min=0, help="Evenly spread scans of a window; 0: all.")
    ] = 0,
    no_align: Annotated[bool, typer.Option("--no-align", help="Windows by odometry as it is.")] = False,
    disjoint: Annotated[bool, typer.Option("--disjoint", help="Windows one after the other.")] = False,
    min_motion_m: Annotated[
        float, typer.Option("--min-motion-m", min=0.0, help="Leave out windows that moved less.")
    ] = 0.0,
    consistent: Annotated[
        bool, typer.Option("--consistent", help="Choose among hypotheses by odometry over the whole log.")
    ] = False,
    one_at_a_time: Annotated[
        bool,
        typer.Option("--one-at-a-time", help="All threads for each scan (latency), not one (throughput)."),
    ] = False,
    sensor: SensorFile = None,
    threads: Threads = 0,
    max_hypotheses: MaxHypotheses = 5,
    time_budget_s: TimeBudget = 0.0,
    translation_step_m: TranslationStep = 0.0,
    rotation_step_deg: RotationStep = 0.5,
    robot_radius_m: RobotRadius = 0.0,
    seed: Seed = 0,
) -> None:
    """A pose per scan (or window of scans) of a log, with no starting guess or a rough one.

    Ctrl-C stops cleanly: what is finished is on disk, whole.
    """
    options = search_options(
        method=method,
        threads=threads,
        max_hypotheses=max(max_hypotheses, CONSISTENT_HYPOTHESES) if consistent else max_hypotheses,
        time_budget_s=time_budget_s,
        translation_step_m=translation_step_m,
        rotation_step_rad=rotation_step_rad(rotation_step_deg),
        robot_radius_m=robot_radius_m,
        seed=seed,
    )
    _require_windows(window_scans, window_s, window_max_scans, no_align, disjoint, min_motion_m)
    for path in (out, results):
        if path is not None:
            require_writable(path)
    if picture is not None:
        require_picture(picture)
    require_distinct({"--out": out, "--results": results, "--picture": picture}, [*map, log, sensor])
    pictures_dir = pictures_dir or (out or Path(".")).parent / "pictures"
    if pictures > 0:
        make_folder(pictures_dir)
    maps = load_maps(map)
    composition = Composition(window_max_scans, not no_align, threads)
    question = Question(maps, read_prior(prior, map), options, one_at_a_time, composition)
    scans = _scans(log, read_log(log, sensor), consistent)
    queries = _queries(scans, window_scans, window_s, disjoint, every, min_motion_m)[:limit]
    if not queries:
        raise InvalidArgument(f"{log}: {len(scans)} scans make no query with these windows")
    drawn = _evenly(len(queries), pictures)

    answers, tally = Answers(), Tally()
    failure: Error | None = None
    with CleanStop() as stop:
        try:
            with progress_bar() as bar, ResultsFile(results) as results_file, naming_prior(prior):
                task = bar.add_task("relocalize", total=len(queries))
                relocalize(
                    scans,
                    queries,
                    question,
                    answers=answers,
                    tally=tally,
                    results_file=results_file,
                    keep=lambda position: consistent or position in drawn,
                    on_progress=lambda n: bar.advance(task, n),
                    stop=stop,
                )
        except Error as error:
            if not answers.queries:
                raise
            failure = error  # what is answered is written first
        if consistent:
            tie_together(answers, scans, question)
            if results is not None:
                lines = [answers.kept[i].to_json(query.last) for i, query in enumerate(answers.queries)]
                rewrite_chosen(results, lines, answers.choices)
        if out is not None:
            write_trajectory(answers.trajectory(), out)
    print_table(tally.rows())
    _draw(answers, scans, question, picture, drawn, pictures_dir)
    _say_what_is_written(answers, out, results, picture, pictures_dir, len(drawn & set(answers.kept)))
    if failure is not None:
        raise failure
    if stop.requested:
        typer.echo(f"landfall: stopped after {len(answers.queries)} of {len(queries)} queries", err=True)
        raise typer.Exit(stop.exit_code)


def _require_windows(
    window_scans: int | None,
    window_s: float | None,
    window_max_scans: int,
    no_align: bool,
    disjoint: bool,
    min_motion_m: float,
) -> None:
    """Options of windows do nothing to single scans: refused rather than passed over."""
    if window_scans is not None or window_s is not None:
        return
    given = {
        "--window-max-scans": window_max_scans > 0,
        "--no-align": no_align,
        "--disjoint": disjoint,
        "--min-motion-m": min_motion_m > 0,
    }
    for option in (name for name, is_given in given.items() if is_given):
        raise InvalidArgument(f"{option} is of windows: give --window-scans or --window-s too")


def _say_what_is_written(
    answers: Answers, out: Path | None, results: Path | None, picture: Path | None, folder: Path, drawn: int
) -> None:
    written = [
        (out, f"{len(answers.trajectory())} poses"),
        (results, f"{len(answers.queries)} results"),
        (picture, "all best poses"),
        (folder if drawn else None, f"{drawn} single answers"),
    ]
    for path, what in written:
        if path is not None:
            print(f"{path}: {what}")


def _scans(path: Path, log: Log, need_odometry: bool) -> list[Scan]:
    scans = log.scans
    for warning in log.warnings:
        typer.echo(f"landfall: warning: {warning}", err=True)
    if not scans:
        raise InvalidArgument(f"{path}: no scans")
    if need_odometry:
        odometry(scans)  # said before the work, not after
    return scans


def _queries(
    scans: list[Scan],
    window_scans: int | None,
    window_s: float | None,
    disjoint: bool,
    every: int,
    min_motion_m: float,
) -> list[Query]:
    if window_scans is not None and window_s is not None:
        raise InvalidArgument("--window-scans and --window-s: give one of them")
    if window_s is not None:
        if not (math.isfinite(window_s) and window_s > 0):
            raise InvalidArgument(f"--window-s {window_s:g}: expected a positive number of seconds")
        queries = time_windows(scans, window_s, disjoint, every)
    elif window_scans is not None:
        queries = scan_windows(len(scans), window_scans, disjoint, every)
    else:
        queries = single_queries(len(scans), every)
    return with_motion(scans, queries, min_motion_m) if min_motion_m > 0 else queries


def _evenly(count: int, wanted: int) -> set[int]:
    """Positions of `wanted` queries spread over all."""
    wanted = min(wanted, count)
    return {round(k * (count - 1) / max(wanted - 1, 1)) for k in range(wanted)}


def _draw(
    answers: Answers,
    scans: list[Scan],
    question: Question,
    picture: Path | None,
    drawn: set[int],
    folder: Path,
) -> None:
    if picture is None and not drawn:
        return
    from landfall.answer_picture import draw_answer  # matplotlib takes a while to import
    from landfall.trajectory_picture import draw_trajectory

    if picture is not None:
        draw_trajectory(question.maps, answers, picture)
    for position in sorted(drawn & set(answers.kept)):
        query = answers.queries[position]
        scan = query.scan(scans, question.composition)
        file = folder / f"query_{query.last:05d}.png"
        draw_answer(question.maps, scan, answers.kept[position], file, max(answers.choices[position], 0))
