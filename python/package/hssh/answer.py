"""Answers: what maps explain an exploration, and how far that is proved.

The fields are those of the answer's JSON, of which ``docs/answer-format.md`` tells every one: metres and radians,
counterclockwise; places, visits, travels and scans count from 0, ranks from 1; what is not known is None.
"""

from __future__ import annotations

import json
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any, overload

import numpy as np

from . import _hssh
from ._notebook import answer_html, map_html
from ._records import build

Rows = tuple[tuple[float, float, float], tuple[float, float, float], tuple[float, float, float]]


@dataclass(frozen=True)
class Evidence:
    """What the places of a log rest on."""

    returns: int
    contradicted: int
    unconfirmed: int
    lost: int
    probability: float


@dataclass(frozen=True)
class Input:
    """What was to be explained, and how much of it is."""

    name: str
    kind: str
    travels: int
    considered: int
    explained: int
    scans: int | None = None
    scans_used: int | None = None
    evidence: Evidence | None = None


@dataclass(frozen=True)
class FoundCounts:
    """How many maps were found, by kind."""

    maps: int
    tied: int
    closed: int
    nearly_closed: int | None = None
    perpendicular: int | None = None


@dataclass(frozen=True)
class Removals:
    """How many successors each axiom removed."""

    no_self_intersection: int
    no_circular_path: int
    max_places: int
    max_genus: int
    perpendicular: int
    consistent_boundaries: int


@dataclass(frozen=True)
class Level:
    """The hypotheses that explain the same number of travels."""

    travels: int
    nodes: int
    maps: int
    refuted: int


@dataclass(frozen=True)
class Search:
    """How it was searched, and what that took."""

    objective: str
    order: str
    closed_only: bool
    stop: str
    nodes: int
    maps_made: int
    refuted: int
    expanded: int
    layouts: int
    found: FoundCounts
    rejected: int
    levels: list[Level]
    seconds: float
    bytes: int
    removals: Removals | None = None


@dataclass(frozen=True)
class Verdict:
    """What came of it, in a word and in a sentence."""

    kind: str
    sentence: str
    lost_at_travel: int | None = None


@dataclass(frozen=True)
class Measure:
    """What preference looks at in a map; the less, the better, the first number first."""

    undetermined_boundaries: int
    paths: int
    places: int
    genus: int


@dataclass(frozen=True)
class Worth:
    """How good a map is: by posterior in nats, by preference its measure."""

    nats: float | None = None
    measure: Measure | None = None


@dataclass(frozen=True)
class Trusted:
    """Something that a proof takes on trust."""

    assumption: str
    sentence: str
    held: bool
    least: float | None = None


@dataclass(frozen=True)
class Certificate:
    """What is proved."""

    proved: bool
    trusted: list[Trusted]
    best: Worth | None = None
    open: Worth | None = None
    rest_probability: float | None = None


@dataclass(frozen=True)
class EndReference:
    """An end of a place."""

    place: int
    end: str


@dataclass(frozen=True)
class End:
    """An end of a place: `state` is "closed", "pending" or "linked"."""

    name: str
    state: str
    label: str | None = None
    bearing: float | None = None
    leads_to: EndReference | None = None
    gateway: tuple[tuple[float, float], tuple[float, float]] | None = None


@dataclass(frozen=True)
class Pose:
    """A frame in the frame of the first place: metres, radians; covariance of (x, y, θ)."""

    x: float
    y: float
    theta: float
    covariance: Rows | None = None

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> np.ndarray:
        return np.array([self.x, self.y, self.theta], dtype=dtype)


@dataclass(frozen=True)
class Place:
    """A place of a map."""

    star: str
    ends: list[End]
    pose: Pose | None = None
    region: int | None = None


@dataclass(frozen=True)
class Link:
    """Two gateways that lead to one another."""

    from_: EndReference = field(metadata={"json": "from"})
    to: EndReference
    way: list[tuple[float, float]] = field(default_factory=list)


@dataclass(frozen=True)
class Path:
    """Places joined by going straight on."""

    places: list[int]
    ahead: list[str]
    circular: bool


@dataclass(frozen=True)
class MapVisit:
    """A visit as one map tells it: `finding` is "start", "predicted", "new_place" or "closure"."""

    place: int
    rotation: int
    finding: str
    entry: str | None = None
    exit: str | None = None
    robot: Pose | None = None


@dataclass(frozen=True)
class Position:
    """Where the robot is at the end."""

    place: int
    rotation: int


@dataclass(frozen=True)
class CostItem:
    """A part of what a map costs."""

    item: str
    nats: float


@dataclass(frozen=True)
class Costs:
    """What a map costs: minus the logarithm of its probability, up to a constant."""

    total: float
    items: list[CostItem]


@dataclass(frozen=True)
class Parting:
    """The first visit that two maps explain differently."""

    visit: int
    first_place: int
    first_rotation: int
    place: int
    rotation: int


@dataclass(frozen=True)
class Test:
    """Travels that find out which of two maps is right."""

    exits: list[EndReference]
    first_arrival: EndReference | None = None
    arrival: EndReference | None = None


@dataclass(frozen=True)
class Difference:
    """What tells a map from the first."""

    sentence: str
    parting: Parting | None = None
    test: Test | None = None


@dataclass(frozen=True)
class Map:
    """A map that explains what is explained."""

    rank: int
    branch: str
    optimal: bool
    tied: bool
    measure: Measure
    closed: bool
    nearly_closed: bool
    places: list[Place]
    links: list[Link]
    paths: list[Path]
    visits: list[MapVisit]
    current: Position
    probability: tuple[float, float] | None = None
    costs: Costs | None = None
    difference: Difference | None = None
    trajectory: list[tuple[float, float, float, float]] = field(default_factory=list)
    _mapped: Any = field(default=None, repr=False, compare=False)

    @property
    def poses(self) -> np.ndarray:
        """ndarray of float64, shape (P, 3): The frame of each place, x, y, θ, in that of the first; NaN where it is not known."""
        unknown = Pose(np.nan, np.nan, np.nan)
        known = [unknown if place.pose is None else place.pose for place in self.places]
        return np.array([(pose.x, pose.y, pose.theta) for pose in known], dtype=float).reshape(-1, 3)

    @property
    def edges(self) -> np.ndarray:
        """ndarray of int64, shape (L, 2): The places that each link joins, in the order in which they were found."""
        return np.array([(link.from_.place, link.to.place) for link in self.links], dtype=np.int64).reshape(-1, 2)

    def to_svg(self, title: str | None = None) -> str:
        """The map as SVG."""
        return self._mapped.picture(self.rank, title, False)

    def to_dot(self, title: str | None = None) -> str:
        """The map as Graphviz DOT."""
        return self._mapped.picture(self.rank, title, True)

    def to_networkx(self) -> Any:
        """The map as a ``networkx.MultiGraph``: places with their stars and poses, links with their ends. Needs networkx."""
        import networkx  # type: ignore[import-untyped]

        graph = networkx.MultiGraph()
        for number, place in enumerate(self.places):
            pose = None if place.pose is None else (place.pose.x, place.pose.y, place.pose.theta)
            graph.add_node(number, star=place.star, pose=pose)
        for link in self.links:
            graph.add_edge(link.from_.place, link.to.place, ends=(link.from_.end, link.to.end))
        return graph

    def _repr_svg_(self) -> str:
        return self.to_svg()

    def _repr_html_(self) -> str:
        return map_html(self)


@dataclass(frozen=True)
class Visit:
    """What the robot met on a visit, and the place that it is in the first map."""

    star: str
    place: int | None = None
    scan: int | None = None
    scans: tuple[int, int] | None = None
    times: tuple[float, float] | None = None
    region: int | None = None


@dataclass(frozen=True)
class Correction:
    """One thing that is taken for misread: `kind` is "missed", "new", "passed", "false" or "turned_back"."""

    kind: str
    visit: int
    sentence: str
    place: int | None = None
    ends: list[str] = field(default_factory=list)


@dataclass(frozen=True)
class Readings:
    """What of the exploration is taken for misread; the maps are those of the exploration as it must have been."""

    nats: float
    nats_of_errors: float
    at_most: float
    proved: bool
    found: int
    corrections: list[Correction]
    visits: list[tuple[int, int]]


@dataclass(frozen=True)
class BuildingRegion:
    """A region of the building along a log: `kind` is "room", "corridor", "hall", "doorway" or "unexplored"."""

    kind: str
    area: float
    width: float
    explored: float
    stays: int
    outline: list[list[tuple[float, float]]]
    places: list[int] = field(default_factory=list)
    passages: list[int] = field(default_factory=list)
    holes: list[list[tuple[float, float]]] = field(default_factory=list)


@dataclass(frozen=True)
class BuildingPassage:
    """Where two regions of the building lead to one another: `kind` is "door" or "opening"."""

    kind: str
    door_probability: float
    regions: tuple[int, int]
    width: float
    line: tuple[tuple[float, float], tuple[float, float]]


@dataclass(frozen=True)
class Stay:
    """A stretch of the robot's way in one region."""

    region: int
    scans: tuple[int, int]


@dataclass(frozen=True)
class Building:
    """The building as all scans of a log draw it where the first map has them."""

    regions: list[BuildingRegion]
    passages: list[BuildingPassage]
    stays: list[Stay]


@dataclass(frozen=True)
class Warning:
    """One thing to know, however often it occurred; `where` are the first spots, such as ``{"scan": 17}``."""

    kind: str
    count: int
    sentence: str
    where: list[dict]


@dataclass(frozen=True)
class Explanation:
    """How a map explains an exploration, in words, once an independent checker agrees."""

    story: list[str]
    check: str

    def __str__(self) -> str:
        return "\n".join([*self.story, self.check])


@dataclass(frozen=True)
class _Head:
    input: Input
    search: Search
    verdict: Verdict
    certificate: Certificate
    visits: list[Visit]
    warnings: list[Warning]
    readings: Readings | None = None
    building: Building | None = None


class Maps(Sequence):
    """The maps of an answer, the best first, each made into an object when it is asked for."""

    def __init__(self, mapped: Any) -> None:
        self._mapped = mapped
        self._made: dict[int, Map] = {}

    def __len__(self) -> int:
        return self._mapped.map_count()

    @overload
    def __getitem__(self, index: int) -> Map: ...

    @overload
    def __getitem__(self, index: slice) -> list[Map]: ...

    def __getitem__(self, index: int | slice) -> Map | list[Map]:
        if isinstance(index, slice):
            return [self[number] for number in range(*index.indices(len(self)))]
        number = range(len(self))[index]
        if number not in self._made:
            data = json.loads(self._mapped.map_json(number))
            made = build(Map, data)
            object.__setattr__(made, "_mapped", self._mapped)
            self._made[number] = made
        return self._made[number]

    def __iter__(self) -> Iterator[Map]:
        return (self[number] for number in range(len(self)))

    def __repr__(self) -> str:
        return f"<{len(self)} maps>"


class Answer:
    """What maps explain an exploration or a log, and how far that is proved.

    `hssh.map` gives one, `Mapper.answer` too; ``Answer.from_json`` reads one. In a notebook it shows the verdict, the ranking
    and the best map.

    Attributes
    ----------
    verdict : Verdict
        What came of it: ``verdict.kind`` for programs, ``verdict.sentence`` for people.
    maps : sequence of Map
        The best maps, the best one first.
    visits : list of Visit
        What the robot visited, and where that is in the first map.
    input, search, certificate, readings, building, warnings
        What was asked, how it was searched, what is proved, what is taken for misread, the building that a log shows, and what to know.
    """

    def __init__(self, mapped: Any) -> None:
        self._mapped = mapped
        head = build(_Head, json.loads(mapped.head_json()))
        self.input: Input = head.input
        self.search: Search = head.search
        self.verdict: Verdict = head.verdict
        self.certificate: Certificate = head.certificate
        self.visits: list[Visit] = head.visits
        self.readings: Readings | None = head.readings
        self.building: Building | None = head.building
        self.warnings: list[Warning] = head.warnings
        self.maps: Maps = Maps(mapped)

    @classmethod
    def from_json(cls, text: str) -> Answer:
        """The answer that a JSON text holds, as `to_json` and ``hssh map --json`` write it."""
        return cls(_hssh.Mapped.from_json(text))

    def to_json(self) -> str:
        """The answer as JSON; equal answers give equal texts."""
        return self._mapped.to_json()

    def to_text(self, levels: bool = False) -> str:
        """The answer as the program prints it; with `levels`, also what the search made of each travel."""
        return self._mapped.to_text(levels)

    @property
    def best(self) -> Map | None:
        """The first map, if there is one."""
        return self.maps[0] if self.maps else None

    @property
    def doubt(self) -> str | None:
        """Why the best map may well be wrong, if it may."""
        return self._mapped.doubt()

    def explain(self, rank: int = 1) -> Explanation:
        """How a map explains the exploration, travel by travel, replayed by code that shares nothing with the search."""
        return build(Explanation, json.loads(self._mapped.explanation_json(rank)))

    def pose_graph(self, rank: int = 1) -> _hssh.PoseGraph | None:
        """The pose graph of a map: a pose for each place, a measurement for each measured travel; None without odometry."""
        return self._mapped.pose_graph(rank)

    def scan_graph(self, rank: int = 1) -> _hssh.PoseGraph | None:
        """Of a log: the pose graph of all its scans, in the frame of the first place of a map; else None."""
        return self._mapped.scan_graph(rank)

    def trajectory(self, rank: int = 1) -> tuple[np.ndarray, np.ndarray] | None:
        """Of a log: when every scan was taken, shape (N,), and where, shape (N, 3), in the frame of the first place; else None."""
        return self._mapped.trajectory(rank)

    def grid(self, rank: int = 1) -> _hssh.Grid:
        """Of a log: the grid map of the whole building, in the frame of the first place of a map."""
        return self._mapped.building(rank)

    def exploration(self) -> _hssh.Exploration:
        """What the maps are of: the exploration, or as it must have been if something is taken for misread."""
        return self._mapped.exploration()

    def export(self, kind: str, rank: int | None = None, *, spacing: float = 5.0) -> str:
        """A map for another program: "nav2", "open_rmf", "tmap", "osmag", "graphml" or "geojson".

        Parameters
        ----------
        kind : str
            For which program.
        rank : int, optional
            Which map; by default the first, which is refused if it is to be driven by and may well be wrong.
        spacing : float
            No two neighboring points of a way are farther apart: metres.
        """
        text, doubts = self._mapped.export(kind, rank, spacing)
        for doubt in doubts:
            warnings.warn(f"{kind} of a map that may be wrong: {doubt}", stacklevel=2)
        return text

    def certificate_text(self) -> str | None:
        """What the proof rests on, for ``hssh verify``; None if nothing is proved."""
        return self._mapped.certificate()

    def tree_svg(self) -> str:
        """The tree of hypotheses as SVG."""
        return self._mapped.tree_picture(False)

    def tree_dot(self) -> str:
        """The tree of hypotheses as Graphviz DOT."""
        return self._mapped.tree_picture(True)

    def __eq__(self, other: object) -> bool:
        return self.to_json() == other.to_json() if isinstance(other, Answer) else NotImplemented

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> tuple:
        return (Answer.from_json, (self.to_json(),))

    def __str__(self) -> str:
        return self.to_text()

    def __repr__(self) -> str:
        return f"<Answer: {self.verdict.sentence}>"

    def _repr_html_(self) -> str:
        return answer_html(self)
