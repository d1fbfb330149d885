"""Objects with attributes from what the crates write as JSON."""

from __future__ import annotations

import dataclasses
import sys
import types
import typing
from functools import lru_cache
from typing import Any


@lru_cache(maxsize=None)
def _fields(cls: type) -> dict[str, Any]:
    return typing.get_type_hints(cls, vars(sys.modules[cls.__module__]))


def build(cls: Any, data: Any) -> Any:
    """What is made of data for an annotation: dataclasses of dicts, lists, tuples and what is optional.

    Fields that a dataclass does not know are passed over, as the format asks of readers; what is left out is None or empty.
    """
    origin, arguments = typing.get_origin(cls), typing.get_args(cls)
    if origin in (typing.Union, types.UnionType):
        chosen = [argument for argument in arguments if argument is not type(None)]
        return None if data is None else build(chosen[0], data)
    if origin is list:
        return [build(arguments[0], item) for item in data]
    if origin is tuple:
        kinds = [arguments[0]] * len(data) if arguments[-1] is Ellipsis else arguments
        return tuple(build(kind, item) for kind, item in zip(kinds, data))
    if isinstance(cls, type) and dataclasses.is_dataclass(cls):
        hints = _fields(cls)
        names = {field.metadata.get("json", field.name): field.name for field in dataclasses.fields(cls)}
        return cls(**{name: build(hints[name], data[key]) for key, name in names.items() if key in data})
    return data
