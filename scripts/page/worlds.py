"""Explorations that the pages of check-page.py are made of, as RON."""

import random

# The ends of a crossing, clockwise from north, and which way they lead.
NORTH, EAST, SOUTH, WEST = range(4)
STEPS = [(0, 1), (1, 0), (0, -1), (-1, 0)]
NAMES = ["0+", "1+", "0-", "1-"]

ONE_PLACE = 'Exploration(stars: { "hall": ["0+", "0- closed"] }, start: "hall", travels: [])'

# Nothing fits: the star at the other end of a corridor that was walked before is another one.
NO_MAP = """Exploration(
    stars: { "a": ["0+", "0- closed"], "b": ["0+ closed", "0-"], "c": ["0+", "0- #door"] },
    start: "a",
    travels: [(exit: "0+", entry: "0-", star: "b"), (exit: "0-", entry: "0+", star: "a"), (exit: "0+", entry: "0-", star: "c")],
)"""

# Names that would be markup if anybody took them for it.
NASTY = ["</script><script>alert(1)</script>", "<img src=x onerror=alert(2)>", "a & b \\\"c\\\" 'd' `e` ${f}", "<!-- --> ]]> \\u{2028} é 日本"]


def nasty():
    """A walk through a corridor of places with nasty names, and back; labels are nasty, too."""
    stars = [f'"{name}": ["0+ #{name}", "0- #{name}"]' for name in NASTY]
    there = [f'(exit: "0+", entry: "0-", star: "{name}")' for name in NASTY[1:]]
    back = [f'(exit: "0-", entry: "0+", star: "{name}")' for name in NASTY[-2::-1]]
    return f'Exploration(stars: {{ {", ".join(stars)} }}, start: "{NASTY[0]}", travels: [{", ".join(there + back)}])'


def streets(width, height, seed=1):
    """A robot that goes through every street of a grid, row by row and then column by column. Every end of every crossing has a sign of its own,
    so that one map is the simplest; travels are measured, and err."""
    chance = random.Random(seed)
    rows = [(x if y % 2 == 0 else width - 1 - x, y) for y in range(height) for x in range(width)]
    end = rows[-1]
    xs = range(end[0], -1, -1) if end[0] else range(width)
    columns = [(x, y if number % 2 else height - 1 - y) for number, x in enumerate(xs) for y in range(height)]
    route = rows + columns[1:]

    def star(x, y):
        ends = []
        for direction, (dx, dy) in enumerate(STEPS):
            is_open = 0 <= x + dx < width and 0 <= y + dy < height
            sign = f" #{x}-{y} {'NESW'[direction]}" if is_open else ""
            ends.append(f'"{NAMES[direction]}{"" if is_open else " closed"} @{90 - 90 * direction}{sign}"')
        return f'"{x}-{y}": [{", ".join(ends)}]'

    def travel(one, other):
        dx, dy = other[0] - one[0], other[1] - one[1]
        leave = STEPS.index((dx, dy))
        x, y, theta = 8 * dx + chance.gauss(0, 0.1), 8 * dy + chance.gauss(0, 0.1), chance.gauss(0, 0.01)
        return (
            f'(exit: "{NAMES[leave]}", entry: "{NAMES[(leave + 2) % 4]}", star: "{other[0]}-{other[1]}", '
            f"odometry: (x: {x:.4f}, y: {y:.4f}, theta: {theta:.5f}, covariance: [0.01, 0.01, 0.0001]))"
        )

    stars = ",\n".join(star(x, y) for x in range(width) for y in range(height))
    travels = ",\n".join(travel(*pair) for pair in zip(route, route[1:]))
    return f'Exploration(stars: {{\n{stars}\n}}, start: "0-0", travels: [\n{travels}\n])'
