"""A loaded module of the checker takes over the code of another source; importers, tables and caches keep theirs."""

from __future__ import annotations

import inspect
import sys
from fractions import Fraction
from functools import cached_property
from pathlib import Path
from types import FunctionType, ModuleType
from typing import Any

CHECKER = Path(__file__).resolve().parents[2] / "fomas_verify" / "checker"
PACKAGE = "fomas_verify.checker"
CONSTANTS = (int, str, tuple, frozenset, Fraction)


def transplant(name: str, source: str) -> None:
    """Let `fomas_verify.checker.<name>` compute as `source` says; whatever its top level raises is raised here."""
    module = sys.modules[f"{PACKAGE}.{name}"]
    fresh: dict[str, Any] = {"__name__": module.__name__, "__file__": module.__file__}
    exec(compile(source, str(module.__file__), "exec"), fresh)
    _swap(vars(module), fresh, module.__name__)
    for key, value in fresh.items():
        if _is_constant(value) and key in vars(module) and vars(module)[key] != value:
            _rebind(key, vars(module)[key], value)
    forget()


def _is_constant(value: object) -> bool:
    """Whether a mutation may have changed it: tables of numbers too, not those of functions."""
    entries = [x for pair in value.items() for x in pair] if isinstance(value, dict) else [value]
    return all(isinstance(entry, CONSTANTS) for entry in entries)


def forget() -> None:
    """Empty the checker's caches."""
    for module in _loaded(PACKAGE):
        for value in vars(module).values():
            if hasattr(value, "cache_clear"):
                value.cache_clear()


def _loaded(*packages: str) -> list[ModuleType]:
    return [module for name, module in list(sys.modules.items()) if name.startswith(packages)]


def _rebind(key: str, old: object, new: object) -> None:
    for module in _loaded(PACKAGE, "tests."):
        if vars(module).get(key) is old:
            setattr(module, key, new)


def _swap(old: Any, new: Any, home: str) -> None:
    """Give the functions of one namespace the code of those of another with the same names."""
    for key, value in new.items():
        if key not in old:
            continue
        if inspect.isclass(value) and value.__module__ == home:
            _swap(vars(old[key]), vars(value), home)
        elif isinstance(function := _function(value), FunctionType) and function.__module__ == home:
            target = _function(old[key])
            target.__code__, target.__defaults__ = function.__code__, function.__defaults__


def _function(value: Any) -> Any:
    if isinstance(value, property):
        return value.fget
    return value.func if isinstance(value, cached_property) else inspect.unwrap(value)
