"""The values of uncertain designs: bounds that hold for every member, and ends one step too far.

K2: sigma = abs(1 - 2 mu). The paper's graph: sigma is least at mu = 0.28597 (theory, section 5).
"""

from fractions import Fraction
from typing import Any

import mpmath
import pytest

from fomas_verify.checker import gain
from fomas_verify.checker.gain import Gain
from tests.checker.builder import PAPER_EDGES, Json, certificate, checked, design, directed_cycle, outcome
from tests.checker.sampled import norm, real, step_matrix
from tests.checker.test_members import GREATEST, K2, LEAST, PAPER, ROUND, SUMMIT, near


def valued(about: Json, name: str, lower: Any, upper: Any) -> tuple[str, str]:
    return outcome(certificate(about, None, **{name: (str(lower), str(upper))}), name)


def sigma_at(mu: str) -> Any:
    return norm(step_matrix({**design(PAPER_EDGES, 5), "mu": mu}))


with mpmath.workdps(40):
    ONE_LESS = (1 - GREATEST, 1 - LEAST)
    C1 = [mpmath.mpf(2) ** real(a) - 1 for a in ("3/5", "9/10")]

VALUES: list[tuple[Json, str, Any, Any]] = [
    (K2, "mu", "1/4", "1/2"),
    (K2, "threshold", near(C1[0], 25, False), near(C1[1], 25, True)),
    (K2, "degree_max", "1", "1"),
    (K2, "lambda2", "2", "2"),
    (K2, "beta", "0", "1/2"),
    (K2, "sigma", "0", "1/2"),
    (K2, "limit", "1/2", "1/2"),
    ({**K2, "mu": ["1/4", "3/4"]}, "beta", "-1/2", "1/2"),
    ({**K2, "mu": ["1/4", "4/5"]}, "sigma", "0", "3/5"),
    ({**K2, "mu": "1/4"}, "sigma", "1/2", "1/2"),
    ({**K2, "mu": ["2/5", "9/20"]}, "sigma", "1/10", "1/5"),
    ({**K2, "mu": ["3/5", "7/10"]}, "sigma", "1/5", "2/5"),
    (PAPER, "mu", near(LEAST, 30, False), near(GREATEST, 30, True)),
    (PAPER, "beta", near(ONE_LESS[0], 30, False), near(ONE_LESS[1], 30, True)),
    ({**PAPER, "h": "17/20"}, "limit", "16/5", "16/5"),
    (ROUND, "mu", "11/10", near(SUMMIT, 32, True)),
    ({**ROUND, "alpha": "1/2", "gamma": ["1", "2"]}, "mu", "28/25", "57/25"),
]


@pytest.mark.parametrize(("about", "name", "lower", "upper"), VALUES)
def test_values_of_every_member(about: Json, name: str, lower: str, upper: str) -> None:
    assert valued(about, name, lower, upper)[0] == "accepted"
    assert valued(about, name, Fraction(lower) - 1, Fraction(upper) + 1)[0] == "accepted"
    step = Fraction(1, 10**18)
    if lower not in ("11/10", "28/25") and name != "limit":
        assert valued(about, name, Fraction(lower) + step, upper)[0] == "refused"
    if upper != "57/25":
        assert valued(about, name, lower, Fraction(upper) - step)[0] == "refused"


@pytest.mark.parametrize(
    ("mu", "least", "greatest"),
    [(("16/100", "20/100"), "1/5", "4/25"), (("30/100", "35/100"), "3/10", "7/20"), (("1/5", "7/20"), None, "1/5")],
)
def test_sigma_of_every_member(mu: tuple[str, str], least: str | None, greatest: str) -> None:
    """sigma is least at 0.28597, where it is 0.818864182 (theory, section 5): within, before or after the interval."""
    about = {**design(PAPER_EDGES, 5), "alpha": "9/10", "mu": list(mu)}
    with mpmath.workdps(40):
        upper = max(sigma_at(mu[0]), sigma_at(mu[1]))
        assert upper == sigma_at(greatest)
        lower = mpmath.mpf("0.81886418") if least is None else sigma_at(least)
        digits = 8 if least is None else 20
        low, high = near(lower, digits, False), near(upper, 20, True)
        assert valued(about, "sigma", low, high)[0] == "accepted"
        assert valued(about, "sigma", near(lower + mpmath.mpf(10) ** -6, 20, False), high)[0] == "refused"
        assert valued(about, "sigma", low, near(upper, 20, False))[0] == "refused"
    assert valued(about, "sigma", "-1", "2")[0] == "accepted"


def test_sigma_that_is_beyond_the_work_allowed() -> None:
    """sigma of a directed cycle is not least at an end here; of 260 agents no more than the ends are looked at."""
    about = {**design(directed_cycle(300), 300), "alpha": "9/10", "mu": ["2/5", "3/5"]}
    assert valued(about, "sigma", "1/2", "2")[0] == "undecided"


@pytest.mark.parametrize(
    "name", ["peak_control", "settling_samples", "settling_time", "rate", "actuator_reach", "margins"]
)
def test_values_that_an_uncertain_design_has_not(name: str) -> None:
    document = certificate(K2)
    more: Json = {
        "peak_control": {"at": 0},
        "settling_samples": {"settle_to": "1/2"},
        "settling_time": {"settle_to": "1/2"},
    }
    bounds: Json = {"lower": "0", "upper": "9", **more.get(name, {})}
    if name == "rate":
        bounds = {"kappa": "1", "rho": "1/2"}
    if name == "margins":
        bounds = {"gain-bound": {"mu": {"inner": ["0", "1"], "outer": ["0", "1"]}}}
    document["values"] = {name: bounds}
    found = [(o.status, o.reason) for o in checked(document).outcomes if o.kind == "value"]
    label = "margins.gain-bound.mu" if name == "margins" else name
    assert found == [("refused", f"not true: {label} exists (the design has an interval)")]


@pytest.mark.parametrize("name", ["beta", "sigma", "lambda2", "limit"])
def test_values_that_do_not_exist(name: str) -> None:
    about = {**design([[1, 2, "1"]], 2), "alpha": "1/2", "mu": ["1/3", "1/2"], "x0": ["1", "2"]}
    assert valued(about, name, "-9", "9") == ("refused", f"not true: {name} exists (Assumption 1 fails)")
    assert valued({**K2, "mu": ["1/2", "1"]}, "limit", "0", "1")[0] == "refused"


def test_the_greatest_mu_where_halving_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    """Both limits leave bounds that are further apart, and true."""
    found = Gain((Fraction(1), Fraction(1)), None, (Fraction(1), Fraction(1)))
    first, last = Fraction(3, 10), Fraction(7, 10)
    for limit, value in (("MAX_PARTS", 3), ("MAX_HALVINGS", 2)):
        with monkeypatch.context() as patched:
            patched.setattr(gain, limit, value)
            bounds = found.greatest(first, last)
        with mpmath.workdps(40):
            assert bounds.lower <= Fraction(mpmath.nstr(SUMMIT, 35)) + Fraction(1, 10**30)
            assert bounds.upper >= Fraction(mpmath.nstr(SUMMIT, 35)) + Fraction(1, 10**9)
