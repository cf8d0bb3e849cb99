"""Every claim proved and refuted on named designs; the verdicts come from closed forms named beside them."""

import re
from fractions import Fraction
from pathlib import Path

import pytest

from fomas_verify.claims.registry import CLAIMS
from fomas_verify.claims.verdict import Verdict, undecided
from fomas_verify.design import design_from_mapping
from fomas_verify.prover import prove

PAPER = {"adjacency": [[0, 0, 0, 1, 1], [1, 0, 1, 0, 0], [1, 1, 0, 0, 0], [0, 1, 1, 0, 0], [0, 0, 0, 1, 0]]}
K44 = {"agents": 8, "edges": [[i, j] for i in range(1, 9) for j in range(1, 9) if (i <= 4) != (j <= 4)]}
IDS = (
    "graph-assumption",
    "gain-bound",
    "memory-inequality",
    "perron-eigenvalues",
    "beta-contraction",
    "repaired-condition",
    "control-bounded",
    "average-consensus",
)
LETTERS = {Verdict.PROVED: "p", Verdict.REFUTED: "r", Verdict.UNDECIDED: "u", Verdict.INAPPLICABLE: "i"}


def family(name: str, agents: int) -> dict[str, object]:
    return {"family": name, "agents": agents}


def verdicts(alpha: str, graph: dict[str, object], **gain: str) -> str:
    """A letter a claim: graph, gain bound, (14), eigenvalues, step with beta, repaired, control, consensus."""
    proof = prove(design_from_mapping({"name": "x", "alpha": alpha, "graph": graph, **gain}))
    return "".join(LETTERS[proof.decisions[name].verdict] for name in IDS)


NAMED = [
    # the issue's own list
    ("9/10", PAPER, {"gamma": "0.15", "h": "0.85"}, "pppprrpp"),
    ("9/10", PAPER, {"gamma": "0.1746", "h": "0.85"}, "pppprppp"),  # gamma >= 0.17453809...
    ("9/10", PAPER, {"gamma": "0.1745", "h": "0.85"}, "pppprrpp"),
    ("9/10", PAPER, {"mu": "1/2"}, "prpprrpp"),  # mu D = 1
    ("9/10", PAPER, {"mu": "2/3"}, "prprrrrr"),  # mu = mu*
    # K2 swaps at mu = 1, is deadbeat at 1/2
    ("9/10", family("path", 2), {"mu": "1"}, "prrrrrrr"),
    ("9/10", family("path", 2), {"mu": "1/2"}, "pppppppp"),
    # a directed cycle at mu = 1 is a permutation; lambda2 = 1 - cos 72 = 0.69 keeps beta = 0.31 below 0.866
    ("9/10", family("directed-cycle", 5), {"mu": "1"}, "prprrrrr"),
    # C4: 0, 2, 2, 4
    ("9/10", family("cycle", 4), {"mu": "1/2"}, "prprrrrr"),
    ("9/10", family("cycle", 4), {"mu": "1/3"}, "pppppppp"),
    # P4 at alpha 1/2: beta = sqrt 2 - 1 = threshold; 1 - 3.41 = -2.41
    ("1/2", family("path", 4), {"mu": "1"}, "prprrrrr"),
    # P4 at mu = 1/2: 1 -+ sqrt 2 / 2, sigma = beta = 0.707 at an irrational tie
    ("9/10", family("path", 4), {"mu": "1/2"}, "prpppppp"),
    # K_{4,4}: 4 (six times), 8; mu = 0.95/4 gives beta = 0.05, sigma = 0.9
    ("9/10", K44, {"mu": "0.2375"}, "pppprrpp"),
    # K5 at alpha 1/2, mu 0.32: beta = -0.6 < -sqrt(3^0.5 - 2^0.5) = -0.5638; at 0.31 it is -0.55
    ("1/2", family("complete", 5), {"mu": "0.32"}, "prrprrpp"),
    ("1/2", family("complete", 5), {"mu": "0.31"}, "prpprrpp"),
    # K5: the step holds iff mu <= 1/5
    ("1/2", family("complete", 5), {"mu": "1/5"}, "pppppppp"),
    ("1/2", family("complete", 5), {"mu": "0.20000000000000000000000000000000000000000000001"}, "pppprppp"),
    # star of 5: 1 (three times), 5; mu = 1/3 gives 2/3 and -2/3; 2^0.7655 - 1 = 0.6999
    ("0.7655", family("star", 5), {"mu": "1/3"}, "prpppppp"),
    ("0.7655", family("star", 5), {"mu": "1/5"}, "pprpprpp"),
    # no edges; two islands; unbalanced; rooted, with mu* = 2 of a chain of weights 1
    ("9/10", {"agents": 3, "edges": []}, {"mu": "1/2"}, "rpiriiii"),
    ("9/10", {"agents": 4, "edges": [[1, 2], [2, 1], [3, 4], [4, 3]]}, {"mu": "1/4"}, "rpiriiii"),
    ("9/10", {"agents": 3, "edges": [[1, 2], [2, 3], [3, 1], [1, 3]]}, {"mu": "1/4"}, "rpipiiii"),
    ("9/10", {"agents": 3, "edges": [[1, 2], [2, 3]]}, {"mu": "19/10"}, "rripiiii"),
    ("9/10", {"agents": 3, "edges": [[1, 2], [2, 3]]}, {"mu": "2"}, "rririiii"),
    # two agents, weights 1e-6, 1e6: lambda2 = 2e-6, 2e6
    ("9/10", {"agents": 2, "edges": [[1, 2, "1e-6"], [2, 1, "1e-6"]]}, {"mu": "0.1"}, "pprpprpp"),
    ("9/10", {"agents": 2, "edges": [[1, 2, "1e6"], [2, 1, "1e6"]]}, {"mu": "0.1"}, "prrrrrrr"),
    # gains and periods far out: beta is 1 - 1e-150 and less, or below -1e100
    ("9/10", PAPER, {"mu": "1e-150"}, "pprprrpp"),
    ("9/10", PAPER, {"mu": "1e-200"}, "pprprrpp"),
    ("9/10", PAPER, {"mu": "1e300"}, "prrrrrrr"),
    ("9/10", PAPER, {"gamma": "1", "h": "1e-200"}, "pprprrpp"),
    ("9/10", PAPER, {"gamma": "1", "h": "1e200"}, "prrrrrrr"),
    # orders far out: the threshold is 7e-10, or 1 - 1e-9
    ("1e-9", PAPER, {"mu": "0.3"}, "pprprrpp"),
    ("1e-9", family("complete", 4), {"mu": "1/4"}, "pppppppp"),
    ("0.999999999", PAPER, {"mu": "0.3"}, "pppprppp"),
    ("1/18446744073709551615", PAPER, {"gamma": "0.3", "h": "2"}, "pprprrpp"),
    ("18446744073709551614/18446744073709551615", PAPER, {"gamma": "0.3", "h": "1"}, "pppprppp"),
]


@pytest.mark.parametrize(("alpha", "graph", "gain", "expected"), NAMED)
def test_named_designs(alpha: str, graph: dict[str, object], gain: dict[str, str], expected: str) -> None:
    assert verdicts(alpha, graph, **gain) == expected


# gamma with beta = 2^alpha - 1 +- 1e-45 on the paper's graph at h = 0.85, by solving for it at 90 digits
ABOVE = "0.149101909466431182828467768954484656989202996149490111640579"
BELOW = "0.149101909466431182828467768954484656989202998375988097561256"


@pytest.mark.parametrize(("gamma", "verdict"), [(ABOVE, "r"), (BELOW, "p")])
def test_within_1e_45_of_the_threshold(gamma: str, verdict: str) -> None:
    assert verdicts("9/10", PAPER, gamma=gamma, h="0.85")[2] == verdict


HAIRS = [Fraction(1, 10**k) for k in (20, 45, 70, 200)]


@pytest.mark.parametrize("hair", HAIRS)
@pytest.mark.parametrize(
    ("position", "alpha", "graph", "tie", "below", "above"),
    [
        (1, "9/10", PAPER, "1/2", "p", "r"),
        (2, "1/2", family("path", 4), "1", "r", "p"),
        (4, "9/10", family("cycle", 4), "1/3", "p", "r"),
        (4, "9/10", family("path", 4), "1/2", "p", "r"),
        (4, "9/10", family("complete", 3), "1/3", "p", "r"),
    ],
)
def test_a_hair_off_a_tie(
    hair: Fraction, position: int, alpha: str, graph: dict[str, object], tie: str, below: str, above: str
) -> None:
    assert verdicts(alpha, graph, mu=str(Fraction(tie) - hair))[position] == below
    assert verdicts(alpha, graph, mu=str(Fraction(tie) + hair))[position] == above


def test_every_claim_stands_once_in_the_order_of_the_contract(checkout: Path) -> None:
    page, _, _ = (checkout / "docs/certificate-format.md").read_text().partition("\n## 8. Regions\n")
    assert [claim.ID for claim in CLAIMS] == re.findall(r"^\| `([a-z]+-[a-z-]+)` \| `[^|]*` \|$", page, re.M)


@pytest.mark.parametrize("verdict", list(Verdict))
def test_a_verdict_has_no_truth_value(verdict: Verdict) -> None:
    with pytest.raises(TypeError, match="four values"):
        bool(verdict)
    with pytest.raises(TypeError):
        assert not verdict


def test_undecided_says_at_how_many_bits() -> None:
    decision = undecided(4096, "x and y")
    assert decision.verdict is Verdict.UNDECIDED
    assert decision.witness == {"bits": 4096}
    assert decision.reason == "x and y; not decided at 4096 bits"


def test_a_tie_over_a_field_of_degree_8_is_never_decided_wrongly() -> None:
    """The path of 32 at mu = 1/2: lambda2 + lambda_N = 4, so the step is true; it may be too much work."""
    proof = prove(design_from_mapping({"name": "x", "alpha": "9/10", "mu": "1/2", "graph": family("path", 32)}))
    assert proof.decisions["beta-contraction"].verdict is not Verdict.REFUTED
    assert proof.decisions["average-consensus"].verdict is Verdict.PROVED


@pytest.mark.parametrize("weight", ["1/" + str((1 << 250) + 1), str((1 << 4000) + 1), "1"])
def test_the_scale_of_the_weights_decides_nothing(weight: str) -> None:
    """On a directed 5-cycle only mu times the weight counts: at 1/1000, beta > 2^alpha - 1 and norm Phi_1 > 1."""
    edges = [[i, i % 5 + 1, weight] for i in range(1, 6)]
    gain = str(Fraction(1, 1000) / Fraction(weight))
    proof = prove(design_from_mapping({"alpha": "9/10", "mu": gain, "graph": {"agents": 5, "edges": edges}}))
    found = proof.decisions["control-norm-bound"]
    assert (found.verdict, found.witness["k"]) == (Verdict.REFUTED, 1)
