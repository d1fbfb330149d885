"""From explorations and logs to maps: all at once, or travel by travel."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable
from typing import Any

from . import _hssh
from .answer import Answer
from .errors import ArgumentError, Interrupted

Pairs = Iterable[tuple[int, int]]


def _given(**options: Any) -> dict[str, Any]:
    return {name: value for name, value in options.items() if value is not None}


def _options(
    *,
    method: str | None = None,
    planar: bool = False,
    max_genus: int | None = None,
    max_places: int | None = None,
    perpendicular: bool = False,
    consistent_boundaries: bool = False,
    self_intersection: bool = False,
    circular_paths: bool = False,
    genus: str | None = None,
    closed: bool = False,
    same: Pairs = (),
    different: Pairs = (),
    score: str | None = None,
    prior: str | None = None,
    weights: tuple[float, float, float] | None = None,
    area: float | None = None,
    best: int | None = None,
    rest: float | None = None,
    likeness: float | None = None,
    readings: bool | dict[str, float] = False,
    patience: int | None = None,
    travels: int | None = None,
    nodes: int | None = None,
    seconds: float | None = None,
    mebibytes: int | None = None,
    threads: int | None = None,
    listed: int | None = 10,
    narrowest: float | None = None,
    shallowest: float | None = None,
    clutter: float | None = None,
) -> str:
    """Options as the crates read them."""
    if planar and max_genus is not None:
        raise ArgumentError("planar is a genus of at most 0: leave out max_genus, or planar")
    if planar:
        max_genus = 0
    axioms = {
        "no_self_intersection": not self_intersection,
        "no_circular_path": not circular_paths,
        "perpendicular": perpendicular,
        "consistent_boundaries": consistent_boundaries,
        **_given(max_genus=max_genus, max_places=max_places),
    }
    if weights is not None:
        c1, c2, c3 = weights
        weights = {"c1": c1, "c2": c2, "c3": c3}  # type: ignore[assignment]
    pairs = {"same": [list(pair) for pair in same], "different": [list(pair) for pair in different]}
    options = {
        "search": {"closed": closed, **_given(method=method, genus=genus, threads=threads)},
        "axioms": axioms,
        "posterior": _given(
            score=score, prior=prior, weights=weights, area=area, best=best, rest=rest, likeness=likeness
        ),
        "visits": pairs,
        "limits": _given(travels=travels, nodes=nodes, seconds=seconds, mebibytes=mebibytes),
        "places": _given(narrowest=narrowest, shallowest=shallowest, clutter=clutter),
        "readings": _given(model={} if readings is True else readings or None, patience=patience),
        "listed": listed,
    }
    try:
        return json.dumps(options, allow_nan=False, default=_number)
    except ValueError as problem:
        raise ArgumentError(f"an option is no finite number: {problem}") from None


def _number(value: Any) -> Any:
    """A number of numpy as Python's."""
    if hasattr(value, "item"):
        return value.item()
    raise TypeError(f"an option is {value!r}, which is no number, text or list")


_SURVEY_OPTIONS = ("narrowest", "shallowest", "clutter")


def survey(
    log: Any, *, narrowest: float | None = None, shallowest: float | None = None, clutter: float | None = None
) -> _hssh.Survey:
    """Finds the places that a robot visited along a log.

    Parameters
    ----------
    log : Log, str or os.PathLike
        The log, or its file.
    narrowest : float, optional
        Passages narrower than this are closed: metres.
    shallowest : float, optional
        Ways that lead on for less than this are no ways out: metres.
    clutter : float, optional
        Obstacles no larger than this are ignored: metres.

    Returns
    -------
    Survey

    Raises
    ------
    SurveyError
        If there is no place along the log.
    Interrupted
        On Ctrl-C; ``partial`` is the survey of the log up to there, if there is one.
    """
    log = _hssh.read_log(log) if isinstance(log, (str, os.PathLike)) else log
    if not isinstance(log, _hssh.Log):
        raise TypeError(f"a survey is of a Log or its file, not of {type(log).__name__}")
    return log._survey(_options(narrowest=narrowest, shallowest=shallowest, clutter=clutter))


def map(source: Any, **options: Any) -> Answer:
    """Finds the maps that explain what a robot saw and did, ranked, with what is proved of them.

    Parameters
    ----------
    source : Exploration, Survey, Log, str or os.PathLike
        What to explain; a log is surveyed first; of a file, its content says what it is.
    method : str, optional
        How to search: "breadth_first" (all maps, level by level), "best_first", "cyclic", "proof" (the best by preference, with
        a proof), "count" (in constant memory), "posterior" (the most probable maps, with a proof), "posterior_best_first",
        "posterior_breadth_first" or "posterior_proof". By default "posterior" if every travel has odometry, else "breadth_first".
    planar : bool
        Only maps that can be drawn in the plane.
    max_genus, max_places : int, optional
        Only maps of at most that genus, with at most so many places.
    perpendicular, consistent_boundaries : bool
        No two paths share two places and no three form a triangle; no place is on both sides of a path, or beside a path that it
        lies on.
    self_intersection, circular_paths : bool
        Whether a path may meet a place twice, and may return into itself.
    genus : {"first", "last"}, optional
        Where the genus stands in the order of preference.
    closed : bool
        Accept closed maps only, and go back until there is one.
    same, different : iterable of (int, int)
        Pairs of visits, counted from 0, the start, that are known to be to the same place, or to different ones.
    score, prior : str, optional
        Of posterior searches: how measurements count ("evidence", "likelihood", "ignored"), and what else ("flat",
        "simplicity", "choices").
    weights : (float, float, float), optional
        Of the prior of simplicity.
    area : float, optional
        New places may be anywhere in so many square metres.
    best : int, optional
        How many of the best maps to prove.
    rest : float, optional
        Go on until all maps not found have at most that probability together.
    likeness : float, optional
        Along logs: the weight of how alike local maps look.
    readings : bool or dict
        Reckon with errors of perception (docs/readings.md); a dict says what they cost.
    patience : int, optional
        With `readings`: the best account counts when it has been the best for so many expansions.
    travels : int, optional
        Explain only the first so many travels.
    nodes : int, optional
        Stop at so many hypotheses.
    seconds : float, optional
        Stop after that time; what is known then is the answer.
    mebibytes : int, optional
        Stop when the tree takes that much memory; 4096 unless said otherwise.
    threads : int, optional
        0 for one per core, which is the default; the result does not depend on it.
    listed : int or None
        How many maps the answer lists; None for all.
    narrowest, shallowest, clutter : float, optional
        Of logs: what counts as a place, as in `survey`.

    Returns
    -------
    Answer

    Raises
    ------
    ArgumentError
        If options make no sense, contradict one another or the exploration.
    SearchError, SurveyError, FileError, FormatError
        If there is no answer.
    Interrupted
        On Ctrl-C. It is a ``KeyboardInterrupt`` whose ``partial`` is the answer as far as it is known (or the survey, if that was
        interrupted).

    Examples
    --------
    >>> import hssh
    >>> crossing, dead_end = hssh.Star("0+ 1+ 0- 1-"), hssh.Star("0+ (0-)")
    >>> exploration = hssh.Exploration(
    ...     {"crossing": crossing, "dead end": dead_end}, "crossing",
    ...     [("0+", "0+", "dead end"), ("0+", "0+", "crossing"), ("1+", "0+", "dead end")],
    ... )
    >>> answer = hssh.map(exploration, planar=True)
    >>> len(answer.maps), answer.best.measure.places
    (1, 3)
    """
    if isinstance(source, (str, os.PathLike)):
        source = _hssh.read(source)
    for name in options:
        if name not in _KNOWN:
            known = ", ".join(sorted(_KNOWN))
            raise TypeError(f"hssh.map() got an unexpected keyword argument '{name}': it takes {known}")
    text = _options(**options)
    if isinstance(source, _hssh.Log):
        source = source._survey(text)
    elif any(options.get(name) is not None for name in _SURVEY_OPTIONS):
        raise ArgumentError("what counts as a place is for logs: an exploration and a survey have their places already")
    if not isinstance(source, (_hssh.Exploration, _hssh.Survey)):
        raise TypeError(f"a map is of an Exploration, a Survey, a Log or a file of one, not of {type(source).__name__}")
    return _answered(lambda: _hssh.map_source(source, text))


def _answered(search: Any) -> Answer:
    try:
        return Answer(search())
    except Interrupted as stop:
        if isinstance(stop.partial, _hssh.Mapped):
            stop.partial = Answer(stop.partial)
        raise


_KNOWN = frozenset(_options.__kwdefaults__ or ())


class Mapper:
    """Maps while the robot goes on: one travel at a time, with an answer whenever one is asked for.

    Nothing is searched twice; after each travel the answer is that of `hssh.map` of all travels so far.

    Parameters
    ----------
    star : Star or str
        The star seen first.
    name : str, optional
        What to call it.
    **options
        Those of `hssh.map`, except for `travels` and `readings`. Without a `method`, the first travel decides: if it is measured,
        the most probable maps are looked for, and every travel has to be measured.

    Examples
    --------
    >>> import hssh
    >>> mapper = hssh.Mapper("0+ 1+ 0- 1-", planar=True)
    >>> mapper.travel("0+", "0+", "0+ (0-)")     # left by 0+, into a dead end
    >>> mapper.travel("0+", "0+", "0+ 1+ 0- 1-")  # and back again
    >>> mapper.travel("1+", "0+", "0+ (0-)")     # left by 1+: the same dead end, or another?
    >>> [map.measure.places for map in mapper.answer().maps]
    [3]
    """

    def __init__(self, star: Any, name: str | None = None, **options: Any) -> None:
        for refused in ("travels", "readings"):
            if options.get(refused):
                raise ArgumentError(f"{refused} is for whole explorations, not for mapping travel by travel")
        self._options = options
        self._online = _hssh.Online(star, name, _options(**options))
        self._is_searched = False

    def travel(
        self,
        exit: str | int,
        entry: str | int,
        star: Any,
        *,
        odometry: Any = None,
        covariance: Any = None,
        name: str | None = None,
    ) -> None:
        """One travel more.

        Parameters
        ----------
        exit : str or int
            The end of the star seen last that the robot left by.
        entry : str or int
            The end of the star seen now that it came in by.
        star : Star or str
            The star seen now.
        odometry : array_like of float, shape (3,), optional
            The frame of this visit in that of the one before: x, y, θ; metres and radians.
        covariance : array_like of float, shape (3, 3) or (3,), optional
            That of the odometry, or its diagonal.
        name : str, optional
            What to call the star, if it was not seen before.

        Raises
        ------
        ArgumentError
            If it cannot have happened, or the search asks for a measurement that is not there. The mapper is as it was then.
        """
        self._online.observe(exit, entry, star, name, odometry, covariance)
        self._is_searched = False

    def advance(self, *, seconds: float | None = None, nodes: int | None = None, mebibytes: int | None = None) -> str:
        """Searches on until everything is explained as well as was asked for, or a limit stops it.

        Returns
        -------
        str
            Why it stopped: "exhausted", "found", "proved", or "node_limit", "time_limit", "memory_limit"; then it may be called again.

        Raises
        ------
        Interrupted
            On Ctrl-C, with the answer so far as its ``partial``; it may be called again.
        """
        limits = _given(seconds=seconds, nodes=nodes, mebibytes=mebibytes)
        if limits:
            self._online.set_limits(_options(**{**self._options, **limits}))
        try:
            stop = self._online.advance()
        except Interrupted as stop:
            stop.partial = Answer(self._online.answer())
            raise
        self._is_searched = True
        return stop

    def answer(self) -> Answer:
        """What is known of all travels so far; searches on first if there are new ones."""
        if not self._is_searched:
            self.advance()
        return Answer(self._online.answer())

    @property
    def exploration(self) -> _hssh.Exploration:
        """Exploration: What was told so far."""
        return self._online.exploration()

    def __len__(self) -> int:
        """How many travels there are."""
        return len(self.exploration)

    def __bool__(self) -> bool:
        return True

    def __repr__(self) -> str:
        return f"<Mapper: {len(self)} travels>"
