"""Answers about a loop that are kept with it, each as long as something it depends on is there.

A loop forgets all of them when it goes, so that a sweep may examine any number of loops. Loops on the same digraph
share what depends on the digraph alone, and at the same alpha what depends on both.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import wraps
from typing import Any, Concatenate, ParamSpec, Protocol, TypeVar

P = ParamSpec("P")
T = TypeVar("T")
Answers = dict[tuple[Any, ...], Any]


@dataclass(frozen=True, eq=False)
class Remembered:
    """The answers about one loop, by what they depend on: digraph; digraph and alpha; the whole design."""

    of_graph: Answers = field(default_factory=dict)
    of_order: Answers = field(default_factory=dict)
    of_loop: Answers = field(default_factory=dict)


class HasAnswers(Protocol):
    """What remembers."""

    @property
    def remembered(self) -> Remembered:
        """Where."""
        ...


L = TypeVar("L", bound=HasAnswers)


def of_loop(function: Callable[Concatenate[L, P], T]) -> Callable[Concatenate[L, P], T]:
    """A function of a loop and further arguments, asked once for each."""
    return _remembering(function, lambda loop: loop.remembered.of_loop)


def of_graph(function: Callable[Concatenate[L, P], T]) -> Callable[Concatenate[L, P], T]:
    """The same for a function that looks at nothing of the design but its digraph."""
    return _remembering(function, lambda loop: loop.remembered.of_graph)


def of_order(function: Callable[Concatenate[L, P], T]) -> Callable[Concatenate[L, P], T]:
    """The same for a function that looks at nothing of the design but its digraph and alpha."""
    return _remembering(function, lambda loop: loop.remembered.of_order)


def _remembering(
    function: Callable[Concatenate[L, P], T], where: Callable[[L], Answers]
) -> Callable[Concatenate[L, P], T]:
    @wraps(function)
    def asked(loop: L, /, *args: P.args, **kwargs: P.kwargs) -> T:
        answers, key = where(loop), (function, *args, *kwargs.items())
        if key not in answers:
            answers[key] = function(loop, *args, **kwargs)
        found: T = answers[key]
        return found

    return asked
