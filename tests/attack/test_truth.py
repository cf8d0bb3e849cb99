"""The judge of certificates against certificates made by hand and mutants whose worth is plain."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

import pytest

from .designs import NAMED
from .mutants import mutants, sweep
from .truth import judge

pytestmark = pytest.mark.slow

Change = Callable[[dict[str, Any]], object]


def changed(data: bytes, change: Change) -> bytes:
    tree = json.loads(data)
    change(tree)
    return json.dumps(tree).encode()


@pytest.mark.parametrize("name", sorted(NAMED))
def test_handmade_certificates_are_true(handmade, name):
    assert judge(handmade[name]).word == "true"


def claim(tree: dict[str, Any], name: str) -> dict[str, Any]:
    return next(item for item in tree["claims"] if item["id"] == name)


FALSE: dict[str, tuple[str, Change]] = {
    "beta too low": ("paper", lambda t: t["values"]["beta"].update(upper="0")),
    "mu nudged": ("paper-as-mu", lambda t: t["values"]["mu"].update(lower="13471/100000")),
    "contraction proved": (
        "paper",
        lambda t: claim(t, "beta-contraction").update(
            verdict="proved", witness={"mu": "1/7", "lambda2_upper": "1", "lambda_max_upper": "3"}
        ),
    ),
    "tie broken": ("c4-third", lambda t: claim(t, "beta-contraction")["witness"].update(mu="333334/1000000")),
    "Q not definite": ("paper", lambda t: claim(t, "control-bounded")["witness"]["Q"][0].__setitem__(0, "0")),
    "Q at a smaller mu": ("paper", lambda t: claim(t, "control-bounded")["witness"].update(mu="1/8")),
    "Y zero": ("k2-swap", lambda t: claim(t, "control-bounded")["witness"].update(Y=[["0"]])),
    "power too small": ("paper-past-mu-star", lambda t: claim(t, "control-bounded")["witness"].update(power=1)),
    "growth beyond mu": ("paper-past-mu-star", lambda t: claim(t, "control-bounded")["witness"].update(mu="1")),
    "e zero": ("paper", lambda t: claim(t, "repaired-condition")["witness"].update(e=["0"] * 5)),
    "e with a sum": ("paper", lambda t: claim(t, "repaired-condition")["witness"].update(e=["1", "0", "0", "0", "0"])),
    "wrong sample": ("k5-negative-beta", lambda t: claim(t, "memory-inequality")["witness"].update(k=0)),
    "reachable": ("two-islands", lambda t: claim(t, "graph-assumption")["witness"].update(unreachable=[1, 2])),
    "sums equal": (
        "unbalanced",
        lambda t: claim(t, "graph-assumption")["witness"]["imbalance"].update({"agent": 2, "in": "1", "out": "1"}),
    ),
    "beta on a broken graph": ("unbalanced", lambda t: t["values"].update(beta={"lower": "-9", "upper": "9"})),
    "undecided on a broken graph": (
        "unbalanced",
        lambda t: claim(t, "memory-inequality").update(verdict="undecided", witness={"bits": 4096}),
    ),
    "inapplicable on a good graph": (
        "paper",
        lambda t: claim(t, "memory-inequality").update(verdict="inapplicable", witness={}),
    ),
    "statement": ("paper", lambda t: claim(t, "gain-bound").update(statement="0 < mu < 1/Delta_max")),
    "another gain": ("paper", lambda t: t["design"].update(gamma="149/1000")),
    "ends crossed": ("paper", lambda t: t["values"]["degree_max"].update(lower="3")),
    "peak too low": ("paper", lambda t: t["values"]["peak_control"].update(upper="101283/100000")),
    "peak not there": ("paper", lambda t: t["values"]["peak_control"].update(at=2)),
    "settled too early": ("paper-trajectory", lambda t: t["values"]["settling_samples"].update(lower="0", upper="19")),
    "settled to nothing": ("paper-trajectory", lambda t: t["values"]["settling_samples"].update(settle_to="0")),
    "settled in samples": ("paper-trajectory", lambda t: t["values"]["settling_time"].update(lower="20", upper="20")),
    "faster than the radius": ("paper", lambda t: t["values"]["rate"].update(kappa="1000000", rho="742/1000")),
    "kappa below sigma": ("paper", lambda t: t["values"]["rate"].update(kappa="1", rho="88/100")),
    "kappa below 1": ("k2-deadbeat", lambda t: t["values"]["rate"].update(kappa="99/100")),
    "rho 1": ("paper", lambda t: t["values"]["rate"].update(rho="1")),
    "reach without x0": ("paper", lambda t: t["values"].update(actuator_reach={"lower": "0", "upper": "1000"})),
    "another limit": ("paper-trajectory", lambda t: t["values"]["limit"].update(lower="-9", upper="3")),
    "limit of vectors": (
        "paper-trajectory",
        lambda t: (t["design"].update(x0=[["1"]] * 5), t["values"].pop("actuator_reach")),
    ),
    "peak of a loop that grows": (
        "paper-past-mu-star",
        lambda t: t["values"].update(peak_control={"lower": "0", "upper": "1000", "at": 0}),
    ),
    "first control not exceeded": ("paper", lambda t: claim(t, "control-norm-bound")["witness"].update(k=2)),
    "consensus from the start": ("paper", lambda t: claim(t, "control-norm-bound")["witness"].update(x0=["1"] * 5)),
    "closed form of a digraph": (
        "paper-repaired",
        lambda t: claim(t, "control-norm-bound").update(witness={"mu": "1/5", "lambda_max_upper": "3"}),
    ),
    "closed form beyond two": (
        "c4-third",
        lambda t: claim(t, "control-norm-bound").update(witness={"mu": "501/1000", "lambda_max_upper": "4"}),
    ),
    "eigenvalue too low": (
        "c4-third",
        lambda t: claim(t, "control-norm-bound").update(witness={"mu": "1/3", "lambda_max_upper": "39/10"}),
    ),
    "trajectory by the closed form of a digraph": (
        "paper-trajectory",
        lambda t: claim(t, "trajectory-norm-bound").update(witness={"mu": "1/7", "lambda_max_upper": "3"}),
    ),
    "not at rest": ("paper-trajectory", lambda t: claim(t, "trajectory-norm-bound").update(witness={})),
    "trajectory without x0": (
        "paper-trajectory",
        lambda t: (t["design"].pop("x0"), t["values"].pop("actuator_reach"), t["values"].pop("limit")),
    ),
}
TRUE: dict[str, tuple[str, Change]] = {
    "undecided": ("paper", lambda t: claim(t, "memory-inequality").update(verdict="undecided", witness={"bits": 4096})),
    "no values": ("paper", lambda t: t.update(values={})),
    "wide": ("paper", lambda t: t["values"]["sigma"].update(lower="-1", upper="100")),
    "one claim": ("paper", lambda t: t.update(claims=t["claims"][2:3])),
    "x0": ("paper", lambda t: t["design"].update(x0=[["1", "2/3"]] * 5)),
    "h with mu": ("paper-as-mu", lambda t: t["design"].update(h="1/3")),
    "Q scaled": ("k2-deadbeat", lambda t: claim(t, "control-bounded")["witness"].update(Q=[["7/3"]])),
    "degree widened": ("no-edges", lambda t: t["values"]["degree_max"].update(lower="-1")),
    "both ends of the tie": (
        "c4-third",
        lambda t: claim(t, "beta-contraction").update(
            witness={"mu": "1/3", "lambda2": {"polynomial": ["-2", "1"], "lower": "1", "upper": "2"}}
        ),
    ),
    "peak widened": ("paper", lambda t: t["values"]["peak_control"].update(lower="1", upper="2")),
    "peak at the start": ("paper", lambda t: t["values"]["peak_control"].update(lower="1", upper="2", at=0)),
    "kappa raised": ("paper", lambda t: t["values"]["rate"].update(kappa="1000")),
    "settling widened": ("paper-trajectory", lambda t: t["values"]["settling_samples"].update(lower="-1", upper="21")),
    "closed form at two": (
        "c4-third",
        lambda t: claim(t, "control-norm-bound").update(witness={"mu": "1/2", "lambda_max_upper": "4"}),
    ),
    "trajectory by the closed form": (
        "k2-deadbeat-trajectory",
        lambda t: claim(t, "trajectory-norm-bound").update(witness={"mu": "1/2", "lambda_max_upper": "2"}),
    ),
    "more samples": (
        "paper-repaired",
        lambda t: claim(t, "control-norm-bound").update(witness={"samples": 5, "powers": 9}),
    ),
    "another start": (
        "paper",
        lambda t: claim(t, "control-norm-bound").update(witness={"x0": ["0", "-1", "-1", "-1", "1"], "k": 1}),
    ),
}
MALFORMED: dict[str, tuple[str, Change]] = {
    "float": ("paper", lambda t: t["values"]["mu"].update(lower=0.1)),
    "bool for k": ("k5-negative-beta", lambda t: claim(t, "memory-inequality")["witness"].update(k=True)),
    "bool for an agent": (
        "two-islands",
        lambda t: claim(t, "graph-assumption")["witness"].update(unreachable=[True, 3]),
    ),
    "bool for agents": ("k2-swap", lambda t: t["design"].update(agents=True)),
    "no claims": ("paper", lambda t: t.update(claims=[])),
    "claim twice": ("paper", lambda t: t["claims"].append(t["claims"][0])),
    "line feed": ("paper", lambda t: t["design"].update(alpha="9/10\n")),
    "arabic": ("paper", lambda t: t["design"].update(alpha="٩/10")),
    "zero below": ("paper", lambda t: t["values"]["mu"].update(lower="0/0")),
    "edge twice": ("paper", lambda t: t["design"]["edges"].append(t["design"]["edges"][0])),
    "name": ("paper", lambda t: t["design"].update(name="paper")),
    "both gains": ("paper", lambda t: t["design"].update(mu="1/7")),
    "no gain": ("paper-as-mu", lambda t: t["design"].pop("mu")),
    "gamma without h": ("paper", lambda t: t["design"].pop("h")),
    "witness of another shape": ("paper", lambda t: claim(t, "control-bounded").update(witness={})),
    "witness for nothing": ("paper", lambda t: claim(t, "gain-bound").update(witness={"k": 0})),
    "upper triangle": ("paper", lambda t: claim(t, "control-bounded")["witness"].update(Q=[["1"] * 4] * 4)),
    "k below 1": ("paper", lambda t: claim(t, "control-norm-bound")["witness"].update(k=0)),
    "no powers": ("paper-trajectory", lambda t: claim(t, "trajectory-norm-bound")["witness"].update(powers=0)),
    "samples below 0": ("paper-trajectory", lambda t: claim(t, "trajectory-norm-bound")["witness"].update(samples=-1)),
    "x0 of the wrong length": ("paper", lambda t: claim(t, "control-norm-bound")["witness"].update(x0=["1"] * 4)),
    "peak without at": ("paper", lambda t: t["values"]["peak_control"].pop("at")),
    "at below 0": ("paper", lambda t: t["values"]["peak_control"].update(at=-1)),
    "at in a string": ("paper", lambda t: t["values"]["peak_control"].update(at="1")),
    "rate with ends": ("paper", lambda t: t["values"]["rate"].update(lower="0")),
    "settling without settle_to": ("paper", lambda t: t["values"]["settling_samples"].pop("settle_to")),
    "k of 81 digits": ("paper", lambda t: claim(t, "control-norm-bound")["witness"].update(k=10**80)),
    "agents beyond memory": ("k2-swap", lambda t: t["design"].update(agents=10**30)),
}


@pytest.mark.parametrize(
    ("word", "name"),
    [(w, n) for w, table in (("false", FALSE), ("true", TRUE), ("malformed", MALFORMED)) for n in table],
)
def test_plain_cases(handmade, word, name):
    source, change = {"false": FALSE, "true": TRUE, "malformed": MALFORMED}[word][name]
    assert judge(changed(handmade[source], change)).word == word


def test_mutants_follow_from_the_seed(handmade):
    few = {name: handmade[name] for name in ("paper", "k2-swap")}
    assert list(mutants(few, 5, 30)) == list(mutants(few, 5, 30))
    assert [m.data for m in mutants(few, 5, 10, start=20)] == [m.data for m in mutants(few, 5, 30)][20:]
    assert list(mutants(few, 5, 30)) != list(mutants(few, 6, 30))


def test_mutants_are_of_every_kind(handmade):
    words = [judge(mutant.data).word for mutant in mutants(handmade, 2, 300)]
    assert all(words.count(word) > 30 for word in ("malformed", "false", "true"))


def test_the_sweep_reaches_every_field(handmade):
    labels = {mutant.label.split(": ")[1] for mutant in sweep("k2-swap", handmade["k2-swap"])}
    assert {
        "$.design.alpha",
        "$.design.edges[1][2]",
        "$.values.sigma.upper",
        "$.claims[7].witness.Y[0][0]",
        "$.tool.version",
    } <= labels
