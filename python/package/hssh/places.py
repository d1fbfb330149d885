"""The places of a grid map: regions, passages, stars and the ways of a robot."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from . import _hssh
from ._notebook import places_html
from ._records import build
from .answer import EndReference

Point = tuple[float, float]


@dataclass(frozen=True)
class Gateway:
    """Where a place or a region leads on: metres and radians in the frame of the map."""

    position: Point
    bearing: float
    width: float
    line: tuple[Point, Point]


@dataclass(frozen=True)
class StarEnd:
    """An end of a star; without a gateway it is closed."""

    name: str
    bearing: float
    gateway: Gateway | None = None


@dataclass(frozen=True)
class GridPlace:
    """A place of a grid map: `kind` is "passage", "dead end", "corner", "junction" or "closed"."""

    kind: str
    center: Point
    star: str
    ends: list[StarEnd]
    clearance: float | None = None
    region: int | None = None


@dataclass(frozen=True)
class Region:
    """A region: `kind` is "room", "corridor", "hall", "doorway" or "outside"."""

    kind: str
    area: float
    width: float
    places: list[int]
    passages: list[int]
    color: str
    outline: list[list[Point]]
    holes: list[list[Point]] = field(default_factory=list)
    name: str | None = None


@dataclass(frozen=True)
class Passage:
    """Where two regions lead to one another: `kind` is "door" or "opening"."""

    kind: str
    door_probability: float
    regions: tuple[int, int]
    is_passable: bool
    position: Point
    bearing: float
    width: float
    line: tuple[Point, Point]


@dataclass(frozen=True)
class Connection:
    """What leads from one place to another."""

    ends: tuple[EndReference, EndReference]
    length: float
    width: float
    line: list[Point]
    passages: list[int] = field(default_factory=list)
    ways: list[int] = field(default_factory=list)


@dataclass(frozen=True)
class RoadNode:
    """A node of the roadmap: `kind` is "place", "passage" or "branch"."""

    kind: str
    region: int
    position: Point
    number: int | None = None


@dataclass(frozen=True)
class Way:
    """A way that a robot can drive in both directions."""

    ends: tuple[int, int]
    region: int
    length: float
    width: float
    line: list[Point]


@dataclass(frozen=True)
class Roadmap:
    """The ways through a map for a robot of a radius."""

    radius: float
    nodes: list[RoadNode]
    ways: list[Way]

    def to_networkx(self) -> Any:
        """The route graph as a ``networkx.MultiGraph``: edges have their length and line. Needs networkx."""
        import networkx  # type: ignore[import-untyped]

        graph = networkx.MultiGraph()
        for number, node in enumerate(self.nodes):
            graph.add_node(number, kind=node.kind, region=node.region, position=node.position)
        for way in self.ways:
            graph.add_edge(*way.ends, length=way.length, width=way.width, line=way.line)
        return graph


@dataclass(frozen=True)
class Constriction:
    """A narrow point of the medial axis."""

    hidden_area: float
    is_door: bool
    position: Point
    bearing: float
    width: float
    line: tuple[Point, Point]


@dataclass(frozen=True)
class _Account:
    places: list[GridPlace]
    connections: list[Connection]
    regions: list[Region] = field(default_factory=list)
    passages: list[Passage] = field(default_factory=list)
    roadmap: Roadmap | None = None
    constrictions: list[Constriction] = field(default_factory=list)


class Places:
    """What is in a grid map; metres and radians in its frame. `find_places` gives it.

    Attributes
    ----------
    regions, passages, places, connections : list
        Regions, where they lead to one another, places with their stars, and what connects these.
    roadmap : Roadmap or None
        The ways of a robot; None with `detail`.
    constrictions : list
        With `detail`: the narrow points of the medial axis.
    """

    def __init__(self, found: Any, grid: Any) -> None:
        self._found = found
        self._grid = grid
        account = build(_Account, json.loads(found.to_json()))
        self.regions: list[Region] = account.regions
        self.passages: list[Passage] = account.passages
        self.places: list[GridPlace] = account.places
        self.connections: list[Connection] = account.connections
        self.roadmap: Roadmap | None = account.roadmap
        self.constrictions: list[Constriction] = account.constrictions

    @property
    def doors(self) -> list[Passage]:
        """The passages that are doors."""
        return [passage for passage in self.passages if passage.kind == "door"]

    def labels(self) -> np.ndarray:
        """The number of the region of each cell, or -1: shape (H, W), int32, the bottom row first."""
        return self._found.labels()

    def export(self, kind: str, *, spacing: float = 5.0) -> str:
        """The map for another program: "nav2", "open_rmf", "tmap", "osmag", "graphml", "geojson" or "regions" (GeoJSON).

        No two neighboring points of a way are farther apart than `spacing`, in metres.
        """
        return self._found.export(kind, spacing)

    def to_json(self) -> str:
        """Everything as JSON, as the program's ``hssh stars --json`` prints it."""
        return self._found.to_json()

    def to_svg(self) -> str:
        """The map with its regions, doors and ways as SVG."""
        return self._found.to_svg(self._grid)

    def _repr_html_(self) -> str:
        return places_html(self)

    def __str__(self) -> str:
        return self._found.to_text()

    def __repr__(self) -> str:
        return f"<Places: {len(self.regions)} regions, {len(self.passages)} passages, {len(self.places)} places>"


def find_places(
    grid: Any,
    *,
    radius: float = 0.25,
    narrowest: float | None = None,
    shallowest: float | None = None,
    clutter: float | None = None,
    unknown_is_free: bool = False,
    detail: bool = False,
    names: Iterable[tuple[float, float, str]] = (),
) -> Places:
    """Finds the regions of a grid map, its doors and places, and the ways of a robot through it.

    Parameters
    ----------
    grid : Grid, str or os.PathLike
        The map, or the YAML file of one.
    radius : float
        The radius of the robot: metres.
    narrowest, shallowest, clutter : float, optional
        Metres: passages narrower are closed; ways that lead on for less are no ways out; obstacles no larger are furniture, which
        parts no rooms.
    unknown_is_free : bool
        Whether unknown cells can be driven; else they are walls.
    detail : bool
        All places of the medial axis instead of one for each region and junction; no roadmap then.
    names : iterable of (float, float, str)
        What people call the region at a point x, y.

    Returns
    -------
    Places

    Raises
    ------
    SurveyError
        If nothing of the map is free, or wide enough.
    KeyboardInterrupt
        On Ctrl-C, when the search for regions, which nothing interrupts, has come to its end.
    """
    grid = _hssh.read_grid(grid) if isinstance(grid, (str, os.PathLike)) else grid
    named = [(float(x), float(y), str(name)) for x, y, name in names]
    found = _hssh.find_places(grid, radius, narrowest, shallowest, clutter, unknown_is_free, detail, named)
    return Places(found, grid)


def place_at(
    grid: Any,
    x: float,
    y: float,
    *,
    narrowest: float | None = None,
    shallowest: float | None = None,
    clutter: float | None = None,
    unknown_is_free: bool = False,
) -> GridPlace:
    """The place around one point of a grid map, with its star.

    Parameters
    ----------
    grid : Grid, str or os.PathLike
        The map, or the YAML file of one.
    x, y : float
        The point: metres in the frame of the map.
    narrowest, shallowest, clutter, unknown_is_free
        As in `find_places`.

    Returns
    -------
    GridPlace
    """
    grid = _hssh.read_grid(grid) if isinstance(grid, (str, os.PathLike)) else grid
    found = _hssh.place_around(grid, x, y, narrowest, shallowest, clutter, unknown_is_free)
    return build(GridPlace, json.loads(found))
