"""Topological maps of places that look alike, pose graphs, laser logs and grid maps, as objects and numpy arrays.

Lengths are in metres, angles in radians, counterclockwise, times in seconds. Places, visits, travels, scans and poses count from 0,
ranks of maps from 1. A pose is a row x, y, θ.

* `PoseGraph`, `read_pose_graph`: least squares on poses in the plane.
* `Star`, `EmbeddedGraph`: local topology, and rotation systems with faces and genus.
* `Exploration`, `read_exploration`, `map`: what a robot saw and did, and the maps that explain it.
* `Mapper`: the same while the robot goes on.
* `Log`, `read_log`, `survey`: laser logs, tracked, surveyed and mapped.
* `Grid`, `read_grid`, `find_places`: grid maps with their regions, doors, places and ways.
* `errors`: everything that is raised.

The package comes with docs/python.md of the repository; what the answers mean is in docs/answer-format.md.
"""

from . import answer, errors, places
from ._hssh import (
    EmbeddedGraph,
    Exploration,
    Grid,
    LaserScan,
    Log,
    Marginals,
    PoseGraph,
    PoseGraphSolution,
    Star,
    Survey,
    Track,
    __version__,
    read,
    read_exploration,
    read_grid,
    read_log,
    read_pose_graph,
)
from .answer import Answer, Map
from .errors import (
    ArgumentError,
    Error,
    FileError,
    FormatError,
    InternalError,
    Interrupted,
    SearchError,
    SolveError,
    SurveyError,
)
from .mapping import Mapper, map, survey
from .places import Places, find_places, place_at
from .travel import Travel

# `map` is not among them, so that a star import keeps the one of Python.
__all__ = [
    "Answer",
    "ArgumentError",
    "EmbeddedGraph",
    "Error",
    "Exploration",
    "FileError",
    "FormatError",
    "Grid",
    "InternalError",
    "Interrupted",
    "LaserScan",
    "Log",
    "Map",
    "Mapper",
    "Marginals",
    "Places",
    "PoseGraph",
    "PoseGraphSolution",
    "SearchError",
    "SolveError",
    "Star",
    "Survey",
    "SurveyError",
    "Track",
    "Travel",
    "__version__",
    "answer",
    "errors",
    "find_places",
    "place_at",
    "places",
    "read",
    "read_exploration",
    "read_grid",
    "read_log",
    "read_pose_graph",
    "survey",
]
