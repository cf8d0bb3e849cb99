"""How many samples are looked at, and that a search which ends there finds nothing rather than something wrong."""

from dataclasses import replace
from fractions import Fraction

import pytest

from fomas_verify.claims import control_norm_bound
from fomas_verify.claims.verdict import Verdict
from fomas_verify.design import design_from_mapping
from fomas_verify.prover.sizes import measure
from fomas_verify.spectrum.control import follow
from fomas_verify.spectrum.loop import Loop
from fomas_verify.spectrum.samples import sample_limit, search


def ring(agents: int, alpha: str = "9/10", mu: str = "1/10") -> Loop:
    graph = {"family": "directed-cycle", "agents": agents}
    return Loop(design_from_mapping({"name": "x", "alpha": alpha, "mu": mu, "graph": graph}))


@pytest.mark.parametrize(
    ("agents", "work"), [(30, 500_000_000), (60, 500_000_000), (61, 150_000_000), (80, 150_000_000), (100, 150_000_000)]
)
def test_the_last_sample_keeps_to_the_work_allowed(agents: int, work: int) -> None:
    last = sample_limit(ring(agents))
    assert last * agents**3 <= work < (last + 1) * agents**3


def test_small_networks_end_at_the_most_samples_of_any_design() -> None:
    assert sample_limit(ring(5)) == 20_000
    assert sample_limit(replace(ring(5), most_samples=7)) == 7


def test_a_search_that_ends_before_its_tail_gives_no_peak_and_no_size_of_it() -> None:
    few = replace(ring(12), most_samples=3)
    assert search(ring(12), 192).peak is not None
    assert search(few, 192).peak is None
    sizes = measure(few, decided_stable=True)
    assert (sizes.peak, sizes.reach, sizes.overshoot) == (None, None, None)
    assert sizes.rate is not None


def test_a_bound_that_the_samples_do_not_show_is_undecided() -> None:
    """beta <= 2^alpha - 1 < sigma, and no sample exceeds 1: one sample alone cannot tell that none ever will."""
    one = replace(ring(6, alpha="887/1000", mu="1/2"), most_samples=1)
    assert control_norm_bound.decide(one).verdict is Verdict.UNDECIDED
    assert control_norm_bound.decide(ring(6, alpha="887/1000", mu="1/2")).verdict is Verdict.PROVED


@pytest.mark.parametrize(
    ("graph", "mu", "x0"),
    [([[0, 0, 1], [1, 0, 0], [0, 1, 0]], "27/200", [4, 5, -1]), ([[0, 1], [1, 0]], "1/2", [1, 0])],
)
@pytest.mark.parametrize("power", [1200, 3000])
def test_a_multiple_of_a_start_has_the_same_trajectory(graph, mu, x0, power) -> None:
    """The square of norm e_0 is exact in the first, and enclosed in the second."""
    design = design_from_mapping({"name": "x", "alpha": "9/10", "mu": mu, "graph": {"adjacency": graph}})
    loop = Loop(design)
    first, second = (follow(loop, [[x * factor for x in x0]], 128) for factor in (Fraction(1), Fraction(1, 3**power)))
    assert (first.above, first.at, first.examined) == (second.above, second.at, second.examined)
    assert first.tail == second.tail
    assert first.largest.overlaps(second.largest)
