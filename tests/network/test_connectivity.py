"""Reachability against a transitive closure computed by repeated relaxation."""

from fractions import Fraction

from hypothesis import given
from hypothesis import strategies as st

from fomas_verify.network import (
    Component,
    Digraph,
    describe_unreachable,
    digraph,
    end_components,
    is_strongly_connected,
    strong_components,
    unreachable_pair,
)

ONE = Fraction(1)


def graph_of(agents: int, pairs: list[tuple[int, int]]) -> Digraph:
    return digraph(agents, ((i, j, ONE) for i, j in dict.fromkeys(pairs) if i != j))


@st.composite
def digraphs(draw: st.DrawFn) -> Digraph:
    agents = draw(st.integers(2, 9))
    agent = st.integers(1, agents)
    return graph_of(agents, draw(st.lists(st.tuples(agent, agent), max_size=3 * agents)))


def closure(graph: Digraph) -> set[tuple[int, int]]:
    """All (i, j) with a directed path from i to j, the empty one included (Warshall)."""
    agents = range(1, graph.agents + 1)
    reach = {(i, i) for i in agents} | {edge[:2] for edge in graph.edges}
    for k in agents:
        reach |= {(i, j) for i in agents if (i, k) in reach for j in agents if (k, j) in reach}
    return reach


@given(digraphs())
def test_strong_components_are_the_classes_of_mutual_reachability(graph: Digraph) -> None:
    reach, agents = closure(graph), range(1, graph.agents + 1)
    classes = {tuple(j for j in agents if (i, j) in reach and (j, i) in reach) for i in agents}
    assert strong_components(graph) == tuple(sorted(classes))


@given(digraphs())
def test_the_first_unreachable_pair(graph: Digraph) -> None:
    reach, agents = closure(graph), range(1, graph.agents + 1)
    missing = sorted((i, j) for i in agents for j in agents if (i, j) not in reach)
    assert unreachable_pair(graph) == (missing[0] if missing else None)
    assert is_strongly_connected(graph) == (not missing)
    assert bool(end_components(graph)) == bool(missing)
    assert len(describe_unreachable(graph)) == len(end_components(graph))


@given(digraphs())
def test_end_components_are_closed_to_the_outside(graph: Digraph) -> None:
    reach, agents = closure(graph), set(range(1, graph.agents + 1))
    found = {component.agents: component for component in end_components(graph)}
    for component in strong_components(graph):
        inside, outside = set(component), agents - set(component)
        entered = any((i, j) in reach for i in outside for j in inside)
        left = any((i, j) in reach for i in inside for j in outside)
        expected = None if (entered and left) or not outside else Component(component, entered, left)
        assert found.get(component) == expected


def test_a_directed_path_of_components() -> None:
    graph = graph_of(5, [(1, 2), (2, 1), (2, 3), (3, 4), (4, 5), (5, 4)])
    assert strong_components(graph) == ((1, 2), (3,), (4, 5))
    assert unreachable_pair(graph) == (3, 1)
    assert describe_unreachable(graph) == (
        "agents 1, 2 hear nobody outside: no other agent reaches them",
        "agents 4, 5 are heard by nobody outside: they reach no other agent",
    )


def test_single_and_isolated_agents_and_long_lists_in_words() -> None:
    assert describe_unreachable(graph_of(3, [(1, 2)])) == (
        "agent 1 hears nobody outside: no other agent reaches it",
        "agent 2 is heard by nobody outside: it reaches no other agent",
        "agent 3 hears nobody outside and is heard by nobody outside",
    )
    ring = graph_of(11, [(i, i % 10 + 1) for i in range(1, 11)])
    assert describe_unreachable(ring)[0].startswith(
        "agents 1, 2, 3, 4, 5, 6, 7, 8, ... (10 agents) hear nobody outside and are"
    )


def test_a_long_path_needs_no_recursion() -> None:
    agents = 20_000
    there = [(i, i + 1) for i in range(1, agents)]
    assert len(strong_components(graph_of(agents, there))) == agents
    assert unreachable_pair(graph_of(agents, there)) == (2, 1)
    assert strong_components(graph_of(agents, [*there, (agents, 1)])) == (tuple(range(1, agents + 1)),)
