"""A travel of a robot, from one place to the next."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Travel:
    """A travel from one place to the next.

    Attributes
    ----------
    exit : str or int
        The end of the star before that the robot left by.
    entry : str or int
        The end of the star after that it came in by.
    star : str
        The star after.
    odometry : array_like of float, shape (3,), optional
        The frame of the arrival in that of the departure: x, y, θ; metres and radians.
    covariance : array_like of float, shape (3, 3) or (3,), optional
        That of the odometry, or its diagonal; m², m·rad, rad².
    """

    exit: str | int
    entry: str | int
    star: str
    odometry: Any = None
    covariance: Any = None

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Travel):
            return NotImplemented

        def same(one: Any, two: Any) -> bool:
            if one is None or two is None:
                return one is two
            return np.array_equal(one, two)

        names = (self.exit, self.entry, self.star) == (other.exit, other.entry, other.star)
        return names and same(self.odometry, other.odometry) and same(self.covariance, other.covariance)

    def __hash__(self) -> int:
        return hash((self.exit, self.entry, self.star))
