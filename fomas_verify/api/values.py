"""Python's objects and numpy's as the values of a design file.

A binary float is read as its shortest decimal, and the design notes it.
"""

from __future__ import annotations

from collections.abc import Mapping
from decimal import Decimal
from fractions import Fraction
from typing import Any


def plain(value: Any) -> object:
    """Numbers of numpy and `decimal` as Python's own, arrays and tuples as lists, whatever they hold included."""
    match value:
        case str() | bool() | int() | Fraction() | None:
            return value
        case float():
            return float(value)
        case Decimal():
            return str(value)
        case Mapping():
            return {key: plain(entry) for key, entry in value.items()}
        case list() | tuple():
            return [plain(entry) for entry in value]
    if hasattr(value, "dtype") and hasattr(value, "tolist"):
        return _of_numpy(value)
    return value


def _of_numpy(value: Any) -> object:
    if value.dtype.kind == "f" and value.dtype.itemsize != 8:  # its shortest decimal, not that of its double
        if getattr(value, "ndim", 0):
            return [_of_numpy(entry) for entry in value]
        return float(str(value))
    return value.tolist()
