"""How answers look in notebooks: well-formed XHTML, with pictures as SVG."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .answer import Answer, Map

    from .places import Places

_STYLE = "border-collapse: collapse"
_MOST_ROWS = 10


def _table(heads: list[str], rows: list[list[Any]]) -> str:
    head = "".join(f"<th>{escape(head)}</th>" for head in heads)
    body = "".join("<tr>" + "".join(f"<td>{escape(str(cell))}</td>" for cell in row) + "</tr>" for row in rows)
    return f'<table style="{_STYLE}"><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>'


def _probability(map: Map) -> str:
    if map.probability is None:
        return "–"
    least, most = map.probability
    return f"{most:.3g}" if least >= 0.99 * most else f"≤ {most:.3g}"


def _row(map: Map) -> list[Any]:
    measure = map.measure
    cost = "–" if map.costs is None else f"{map.costs.total:.3f}"
    closed = "yes" if map.closed else "no"
    numbers = [measure.undetermined_boundaries, measure.paths, measure.places, measure.genus]
    return [f"{map.rank}{' *' if map.optimal else ''}", _probability(map), cost, *numbers, closed]


def answer_html(answer: Answer) -> str:
    """The verdict, what makes it doubtful, the ranking and the best map."""
    parts = [f"<p><strong>{escape(answer.verdict.sentence)}</strong></p>"]
    if answer.doubt is not None:
        parts.append(f"<p>DOUBTFUL: {escape(answer.doubt)}</p>")
    if answer.maps:
        heads = ["rank", "probability", "cost", "undetermined", "paths", "places", "genus", "closed"]
        parts.append(_table(heads, [_row(map) for map in answer.maps[:_MOST_ROWS]]))
        unlisted = answer.search.found.maps - min(len(answer.maps), _MOST_ROWS)
        if unlisted > 0:
            parts.append(f"<p>… and {unlisted} more</p>")
        parts.append(answer.maps[0].to_svg())
    if answer.warnings:
        items = "".join(f"<li>{escape(warning.sentence)}</li>" for warning in answer.warnings)
        parts.append(f"<ul>{items}</ul>")
    return f"<div>{''.join(parts)}</div>"


def map_html(map: Map) -> str:
    """A map with its picture and its places."""
    rows = [
        [number, place.star, "–" if place.pose is None else f"{place.pose.x:.2f}, {place.pose.y:.2f}"]
        for number, place in enumerate(map.places)
    ]
    return f"<div>{map.to_svg()}{_table(['place', 'star', 'x, y (m)'], rows)}</div>"


def places_html(places: Places) -> str:
    """The picture of a grid map with its regions, and their list."""
    heads = ["region", "kind", "name", "area (m²)", "width (m)"]
    rows = [
        [number, region.kind, region.name or "", f"{region.area:.1f}", f"{region.width:.2f}"]
        for number, region in enumerate(places.regions)
    ]
    return f"<div>{places.to_svg()}{_table(heads, rows)}</div>"
