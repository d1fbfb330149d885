"""Small worlds to explore, made here and by nothing of the package: grids of crossings."""

from __future__ import annotations

import hssh

# Clockwise from north: the row and the column that each end leads to.
STEPS = [(-1, 0), (0, 1), (1, 0), (0, -1)]
NAMES = ["0+", "1+", "0-", "1-"]


def snake(rows: int, columns: int) -> list[tuple[int, int]]:
    """Rows alternately from the north-west corner, then columns alternately from where the rows ended."""
    route = []
    for row in range(rows):
        order = range(columns) if row % 2 == 0 else range(columns - 1, -1, -1)
        route += [(row, column) for column in order]
    row, column = route[-1]
    across = range(columns) if column == 0 else range(columns - 1, -1, -1)
    for number, column in enumerate(across):
        down = range(rows - 1, -1, -1) if (number % 2 == 0) == (row == rows - 1) else range(rows)
        route += [(row, column) for row in down]
    return [place for place, before in zip(route, [None, *route]) if place != before]


def star_of(rows: int, columns: int, place: tuple[int, int]) -> str:
    """The star of a crossing, with walls closed."""
    row, column = place
    open_ends = [0 <= row + down < rows and 0 <= column + right < columns for down, right in STEPS]
    return " ".join(name if is_open else f"({name})" for name, is_open in zip(NAMES, open_ends))


def explored(rows: int, columns: int, route: list[tuple[int, int]]) -> hssh.Exploration:
    """What a robot sees and does that goes along a route."""
    travels = []
    for (row, column), there in zip(route, route[1:]):
        direction = STEPS.index((there[0] - row, there[1] - column))
        travels.append((NAMES[direction], NAMES[(direction + 2) % 4], star_of(rows, columns, there)))
    stars = {star: star for star in dict.fromkeys(star_of(rows, columns, place) for place in route)}
    return hssh.Exploration(stars, star_of(rows, columns, route[0]), travels)
