"""Reachability in a digraph, in time linear in agents and edges.

A directed path from i to j follows edges (from, to), the way information flows. Source: the paper's Assumption 1
(strong connectivity); Tarjan, "Depth-first search and linear graph algorithms", 1972.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from fomas_verify.network.digraph import Digraph

_NAMED_AGENTS = 8


@dataclass(frozen=True)
class Component:
    """A strong component: agents that reach one another, sorted.

    `hears_outside` and `heard_outside` say whether an edge enters it from outside, and whether one leaves it.
    """

    agents: tuple[int, ...]
    hears_outside: bool
    heard_outside: bool


def strong_components(graph: Digraph) -> tuple[tuple[int, ...], ...]:
    """Return the strong components, each sorted, in the order of their smallest agents."""
    return tuple(sorted(tuple(sorted(component)) for component in _tarjan(_successors(graph))))


def is_strongly_connected(graph: Digraph) -> bool:
    """Say whether there is a directed path from every agent to every other."""
    return unreachable_pair(graph) is None


def unreachable_pair(graph: Digraph) -> tuple[int, int] | None:
    """Return the first pair (i, j), in lexicographic order, without a directed path from i to j, or None."""
    agents = range(1, graph.agents + 1)
    reached = _reach(_successors(graph), 1)
    if missed := next((j for j in agents if j not in reached), None):
        return (1, missed)
    # Agent 1 reaches everyone, so an agent that cannot reach everyone cannot reach agent 1.
    reaching = _reach(_predecessors(graph), 1)
    stranded = next((i for i in agents if i not in reaching), None)
    return None if stranded is None else (stranded, 1)


def end_components(graph: Digraph) -> tuple[Component, ...]:
    """Return the strong components that hear nobody outside or are heard by nobody outside.

    No agent outside reaches one that hears nobody outside; one that is heard by nobody outside reaches no agent
    outside. Empty iff the digraph is strongly connected.
    """
    components = strong_components(graph)
    if len(components) == 1:
        return ()
    home = {agent: index for index, agents in enumerate(components) for agent in agents}
    crossing = [(home[source], home[target]) for source, target, _ in graph.edges if home[source] != home[target]]
    heard, hearing = {source for source, _ in crossing}, {target for _, target in crossing}
    return tuple(
        Component(agents, index in hearing, index in heard)
        for index, agents in enumerate(components)
        if index not in hearing or index not in heard
    )


def describe_unreachable(graph: Digraph) -> tuple[str, ...]:
    """Say which agents cannot reach which, a sentence for each component of `end_components`."""
    return tuple(_sentence(component) for component in end_components(graph))


def _sentence(component: Component) -> str:
    names = ", ".join(map(str, component.agents[:_NAMED_AGENTS]))
    count = len(component.agents)
    if count > _NAMED_AGENTS:
        names += f", ... ({count} agents)"
    subject, hear, are, they, them = (
        (f"agents {names}", "hear", "are", "they reach", "them")
        if count > 1
        else (f"agent {names}", "hears", "is", "it reaches", "it")
    )
    if not component.hears_outside and not component.heard_outside:
        return f"{subject} {hear} nobody outside and {are} heard by nobody outside"
    if not component.hears_outside:
        return f"{subject} {hear} nobody outside: no other agent reaches {them}"
    return f"{subject} {are} heard by nobody outside: {they} no other agent"


def _successors(graph: Digraph) -> list[list[int]]:
    return _neighbours(graph.agents, ((source, target) for source, target, _ in graph.edges))


def _predecessors(graph: Digraph) -> list[list[int]]:
    return _neighbours(graph.agents, ((target, source) for source, target, _ in graph.edges))


def _neighbours(agents: int, pairs: Iterable[tuple[int, int]]) -> list[list[int]]:
    """List the second members of pairs under the first, at index 1..N."""
    lists: list[list[int]] = [[] for _ in range(agents + 1)]
    for first, second in pairs:
        lists[first].append(second)
    return lists


def _reach(neighbours: list[list[int]], start: int) -> set[int]:
    reached, frontier = {start}, [start]
    while frontier:
        for agent in neighbours[frontier.pop()]:
            if agent not in reached:
                reached.add(agent)
                frontier.append(agent)
    return reached


def _tarjan(successors: list[list[int]]) -> Iterator[list[int]]:
    """Yield the strong components; `low` is the smallest visiting number that an agent was seen to reach in its own."""
    low: dict[int, int] = {}
    number: dict[int, int] = {}
    open_agents: list[int] = []
    for root in range(1, len(successors)):
        trail = [] if root in number else [(root, iter(successors[root]))]
        while trail:
            agent, rest = trail[-1]
            if agent not in number:
                number[agent] = low[agent] = len(number)
                open_agents.append(agent)
            child = next(rest, None)
            if child is None:
                trail.pop()
                if trail:
                    low[trail[-1][0]] = min(low[trail[-1][0]], low[agent])
                if low[agent] == number[agent]:
                    yield _close(open_agents, agent, low, len(successors))
            elif child not in number:
                trail.append((child, iter(successors[child])))
            else:
                low[agent] = min(low[agent], low[child])


def _close(open_agents: list[int], root: int, low: dict[int, int], closed: int) -> list[int]:
    """Take a finished component off the stack; `closed`, above every number, keeps it from lowering another `low`."""
    component: list[int] = []
    while not component or component[-1] != root:
        component.append(open_agents.pop())
        low[component[-1]] = closed
    return component
