"""Names of nodes become agents 1..N.

Integers in their numerical order, other names in the order of the file: where that is not 1, 2, ..., N, a remark says
which agent is which.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from fomas_verify.exact.rational import excerpt

_INTEGER = re.compile(r"0|-?[1-9][0-9]{0,18}")


def numbering(names: Sequence[str]) -> tuple[list[int], tuple[str, ...]]:
    """The agent, counting from 0, of each name, the names being different; and the remark, if there is one."""
    if all(map(_INTEGER.fullmatch, names)):
        integers = [int(name) for name in names]
        order = sorted(range(len(names)), key=integers.__getitem__)
        agents = [0] * len(names)
        for agent, position in enumerate(order):
            agents[position] = agent
        return agents, remark_on([integers[position] for position in order])
    return list(range(len(names))), (_remark([excerpt(name) for name in names], "the file"),)


def remark_on(integers: Sequence[int]) -> tuple[str, ...]:
    """The remark on agents called by these integers, sorted; none where they are 1, 2, ..., N."""
    if len(integers) and integers[0] == 1 and integers[-1] == len(integers):
        return ()
    return (_remark([str(integer) for integer in (*integers[:3], *integers[-1:])], "their names", len(integers)),)


def _remark(names: Sequence[str], order: str, count: int | None = None) -> str:
    agents = len(names) if count is None else count
    shown = [f"{agent} is {name}" for agent, name in zip(range(1, min(agents, 3) + 1), names, strict=False)]
    if agents > 3:
        shown += [*(["..."] if agents > 4 else []), f"{agents} is {names[-1]}"]
    return f"agents are numbered in the order of {order}: {', '.join(shown)}"
