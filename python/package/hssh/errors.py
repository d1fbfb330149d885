"""What can go wrong: one tree of exceptions, in the words of the program."""

from __future__ import annotations

from typing import Any


class Error(Exception):
    """Whatever hssh refuses to do, or cannot."""


class ArgumentError(Error, ValueError):
    """An argument that makes no sense: a shape, a number that is not finite, an option that does not exist."""


class FileError(Error, OSError):
    """A file that cannot be opened or read."""

    def __str__(self) -> str:
        return str(self.args[0]) if self.args else ""


class FormatError(Error, ValueError):
    """A text or a file that is not what it should be.

    Attributes
    ----------
    line, column : int or None
        Where, counted from 1, if that is known.
    """

    line: int | None = None
    column: int | None = None


class SolveError(Error, ArithmeticError):
    """A pose graph without a solution."""


class SearchError(Error):
    """A search that cannot begin, or an answer of which something cannot be had."""


class SurveyError(Error):
    """A log along which there are no places, or a grid map in which there are none."""


class InternalError(Error, RuntimeError):
    """What must not happen: a bug in hssh, please report it with the input."""


class Interrupted(KeyboardInterrupt):
    """Ctrl-C during long work: it stopped soon after, and what it knew is here.

    Attributes
    ----------
    partial : object or None
        What the call would have returned, as far as it got: an `Answer`, a `Survey`, a `Track`, a `PoseGraphSolution`; None if
        there is nothing yet.
    """

    def __init__(self, partial: Any = None) -> None:
        known = "" if partial is None else ": what is known so far is in `partial`"
        super().__init__("interrupted" + known)
        self.partial = partial
