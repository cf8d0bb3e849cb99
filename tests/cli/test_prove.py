"""``verify-design prove``: the numbers of the paper's design, verdicts, exit statuses, files and refusals."""

import json
import re
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from subprocess import CompletedProcess

import pytest

Verify = Callable[..., CompletedProcess[str]]

# docs/theory, section 3, and the issue: each digit is a digit of the exact number
NUMBERS = {
    "mu": "0.134740746183943825882",
    "beta": "0.865259253816056174117",
    "threshold": "0.866065983073614831962",
    "sigma": "0.881292727478182555",
    "lambda2": "1",
    "degree_max": "2",
}
WIDTHS = {"mu": 30, "beta": 30, "threshold": 30, "lambda2": 30, "sigma": 12, "degree_max": 30}
VERDICTS = {
    "graph-assumption": "proved",
    "gain-bound": "proved",
    "memory-inequality": "proved",
    "perron-eigenvalues": "proved",
    "beta-contraction": "refuted",
    "repaired-condition": "refuted",
    "control-bounded": "proved",
    "average-consensus": "proved",
}
PAPER = "examples/paper.toml"
RING = 'name = "ring"\nalpha = 0.9\nmu = 1\n[graph]\nfamily = "directed-cycle"\nagents = 5\n'
UNBALANCED = 'name = "u"\nalpha = 0.9\nmu = "1/3"\n[graph]\nagents = 3\nedges = [[1,2],[2,3],[3,1],[1,3]]\n'


def write(folder: Path, text: str) -> Path:
    path = folder / "design.toml"
    path.write_text(text)
    return path


def test_the_papers_design_in_the_table(verify: Verify) -> None:
    run = verify("prove", PAPER)
    assert (run.returncode, run.stderr) == (0, "")
    for name, verdict in VERDICTS.items():
        assert re.search(rf"^[* ] {name} +{verdict} ", run.stdout, re.M)
    required = set(re.findall(r"^\* ([a-z-]+)", run.stdout, re.M))
    assert required == {name for name, verdict in VERDICTS.items() if verdict == "proved"}
    for number in NUMBERS.values():
        assert number in run.stdout
    assert "0.000806729257558" in run.stdout
    assert "eigenvalues of L: 0, 2, 2 +- i, 3" in run.stdout
    assert re.search(r"mu\* = 2/3\b", run.stdout)
    assert re.search(r"raise gamma to at least 0\.174539 ", run.stdout)
    for name in ("beta-contraction", "repaired-condition"):
        (meaning,) = re.findall(rf"^{name} is refuted: (.+?)$", run.stdout, re.M)
        assert len(meaning) > 40
    assert "All 6 required claims are proved." in run.stdout


def test_the_papers_design_in_the_certificate(verify: Verify) -> None:
    run = verify("prove", PAPER, "--json")
    assert (run.returncode, run.stderr) == (0, "")
    document = json.loads(run.stdout)
    found = {claim["id"]: claim["verdict"] for claim in document["claims"]}
    assert {name: found[name] for name in VERDICTS} == VERDICTS
    for name, digits in NUMBERS.items():
        lower, upper = (Fraction(document["values"][name][end]) for end in ("lower", "upper"))
        low = Fraction(digits)
        unit = Fraction(1, 10 ** len(digits.partition(".")[2])) if "." in digits else 0
        assert low <= lower <= upper <= low + unit
        assert upper - lower < Fraction(1, 10 ** WIDTHS[name])
    margin = [Fraction(document["values"]["threshold"][end]) for end in ("lower", "upper")]
    margin = [
        margin[0] - Fraction(document["values"]["beta"]["upper"]),
        margin[1] - Fraction(document["values"]["beta"]["lower"]),
    ]
    assert Fraction("0.000806729257558657") <= margin[0] <= margin[1] <= Fraction("0.000806729257558658")


def test_the_papers_counterexample_refutes_both_steps(verify: Verify) -> None:
    """In exact arithmetic, with mu, beta and the threshold at the ends that make it hardest."""
    document = json.loads(verify("prove", PAPER, "--json").stdout)
    values = document["values"]
    bounds = {"beta-contraction": values["beta"]["upper"], "repaired-condition": values["threshold"]["upper"]}
    rows = [[0, 0, 0, 1, 1], [1, 0, 1, 0, 0], [1, 1, 0, 0, 0], [0, 1, 1, 0, 0], [0, 0, 0, 1, 0]]
    for claim in document["claims"]:
        if claim["id"] not in bounds:
            continue
        e = [Fraction(x) for x in claim["witness"]["e"]]
        assert sum(e) == 0
        for mu in (Fraction(values["mu"]["lower"]), Fraction(values["mu"]["upper"])):
            step = [
                x - mu * sum(a * (x - y) for a, y in zip(row, e, strict=True)) for x, row in zip(e, rows, strict=True)
            ]
            assert sum(x * x for x in step) > Fraction(bounds[claim["id"]]) ** 2 * sum(x * x for x in e)


@pytest.mark.parametrize(
    ("example", "status"),
    [("paper", 0), ("complete8", 0), ("path4", 0), ("repaired", 0), ("ring10", 0), ("unbalanced", 0)],
)
def test_the_examples(verify: Verify, example: str, status: int) -> None:
    run = verify("prove", f"examples/{example}.toml")
    assert (run.returncode, run.stderr) == (status, "")


@pytest.mark.parametrize("text", [RING, UNBALANCED])
def test_a_required_claim_refuted_or_inapplicable_is_status_1(verify: Verify, tmp_path: Path, text: str) -> None:
    run = verify("prove", write(tmp_path, text))
    assert (run.returncode, run.stderr) == (1, "")
    assert run.stdout.rstrip().splitlines()[-1].startswith("Not every required claim is proved: ")


def test_columns_do_not_run_together(verify: Verify, tmp_path: Path) -> None:
    run = verify("prove", write(tmp_path, UNBALANCED))
    assert re.search(r"^\* average-consensus +inapplicable +Assumption 1 fails", run.stdout, re.M)


def test_the_file_is_what_json_prints_and_a_former_one_is_replaced(verify: Verify, tmp_path: Path) -> None:
    path = tmp_path / "certificate.json"
    path.write_text("former")
    table = verify("prove", PAPER, "-o", path)
    printed = verify("prove", PAPER, "--json", "--output", path)
    assert table.returncode == printed.returncode == 0
    assert path.read_text() == printed.stdout
    assert table.stdout == verify("prove", PAPER).stdout
    assert [entry.name for entry in tmp_path.iterdir()] == ["certificate.json"]


def test_a_certificate_is_written_whatever_the_verdict(verify: Verify, tmp_path: Path) -> None:
    path = tmp_path / "certificate.json"
    assert verify("prove", write(tmp_path, RING), "-o", path).returncode == 1
    assert {claim["id"]: claim["verdict"] for claim in json.loads(path.read_text())["claims"]}[
        "gain-bound"
    ] == "refuted"


def test_the_horizon(verify: Verify) -> None:
    run = verify("prove", PAPER, "--horizon", 1000)
    assert run.returncode == 0
    assert "(14) term by term at k = 0..1000: holds at each of them" in run.stdout
    assert re.search(r"smallest 0\.000931487061407\.\.\. at k = 0", run.stdout)  # 0.000806729.../0.866065983...
    assert re.search(r"absolute slack .* tends to 0 for every design", run.stdout)
    certificate = verify("prove", PAPER, "--horizon", 1000, "--json").stdout
    assert certificate == verify("prove", PAPER, "--json").stdout


NEAR = 'name = "n"\nalpha = 0.9\nmu = "{}"\n[graph]\nfamily = "directed-cycle"\nagents = 4\n'


def test_a_horizon_never_says_that_what_is_refuted_holds(verify: Verify, tmp_path: Path) -> None:
    """beta is 1e-70 above 2^0.9 - 1 = 0.8660...: too near for the sum, not for the claim. lambda2 = 1."""
    threshold = Fraction("0.86606598307361483196268653229987878933842310149632770370602")
    near = write(tmp_path, NEAR.format(1 - threshold))
    run = verify("prove", near, "--horizon", 5, "--digits", 20)
    assert re.search(r"memory-inequality +(proved|refuted)", run.stdout)
    assert "holds at each of them" not in run.stdout
    assert "equality, decided exactly" not in run.stdout


@pytest.mark.parametrize("digits", [20, 400])
def test_digits_of_the_values(verify: Verify, digits: int) -> None:
    document = json.loads(verify("prove", PAPER, "--json", "--digits", digits).stdout)
    for name in ("mu", "beta", "threshold"):
        lower, upper = (Fraction(document["values"][name][end]) for end in ("lower", "upper"))
        assert upper - lower < Fraction(1, 10**digits)
        assert lower <= Fraction(NUMBERS[name]) + Fraction(1, 10**21)
        assert Fraction(NUMBERS[name]) <= upper


def test_without_assertions_all_is_the_same(verify: Verify) -> None:
    plain, optimised = (verify("prove", PAPER, "--json", "--horizon", 50, flags=flags) for flags in ((), ("-O",)))
    assert (plain.stdout, plain.returncode) == (optimised.stdout, optimised.returncode)


def test_agents_with_several_states(verify: Verify, tmp_path: Path) -> None:
    """Remark 1: two components of x_0, the first the paper's; a limit for each, norms over both."""
    rows = "[[4.5, 1], [5, 0], [6, 0], [1.5, 1], [-1, 2]]"
    text = Path(PAPER).read_text().replace("[4.5, 5, 6, 1.5, -1]", rows)
    assert rows in text
    design, certificate = write(tmp_path, text), tmp_path / "certificate.json"
    found = verify("prove", design, "-o", certificate)
    assert (found.returncode, "every x_i(t) tends to (3.2, 0.8)" in found.stdout) == (0, True)
    document = json.loads(certificate.read_text())
    assert document["design"]["x0"][:2] == [["9/2", "1"], ["5", "0"]]
    assert "limit" not in document["values"]
    assert verify("check", certificate, "--design", design).returncode == 0
    other = write(tmp_path, text.replace("[5, 0]", "[5, 1]"))
    assert verify("check", certificate, "--design", other).returncode == 1


def test_how_much_room_the_papers_design_has(verify: Verify, tmp_path: Path) -> None:
    """The issue: gamma may fall by 0.6 % before (14) fails, and must rise to 0.174538096247815173... for the repair."""
    certificate = tmp_path / "certificate.json"
    text = " ".join(verify("prove", PAPER, "-o", certificate).stdout.split())
    assert "gamma may fall by 0.598 % (memory-inequality binds) and rise by 271 % (gain-bound binds)" in text
    assert "repaired-condition false here; true for gamma times 1.16359 to 2.94283" in text
    assert "(gamma = 0.174538096247815173... at least)" in text
    values = json.loads(certificate.read_text())["values"]
    mu = Fraction(values["mu"]["lower"])
    least, enough = (Fraction(values["margins"]["repaired-condition"]["mu"][key][0]) for key in ("outer", "inner"))
    for end in (least, enough):
        assert abs(end / mu * Fraction("0.15") - Fraction("0.1745380962478151735")) < Fraction(1, 10**18)
    assert verify("check", certificate, "--design", PAPER, "--require", "design").returncode == 0


@pytest.mark.parametrize("text", ["10^3", "1e3", "1000"])
def test_a_horizon_as_a_power_of_ten(verify: Verify, text: str) -> None:
    run = verify("prove", PAPER, "--horizon", text)
    assert run.returncode == 0
    assert "k = 0..1000" in run.stdout


@pytest.mark.parametrize("text", ["10^10", "2^10", "1.5e3", "1e-3", "e7", "10^", "0e3", "-1e3", "1e999"])
def test_what_is_no_horizon(verify: Verify, text: str) -> None:
    run = verify("prove", PAPER, "--horizon", text)
    assert (run.returncode, run.stdout) == (2, "")
    assert "'--horizon'" in run.stderr


@pytest.mark.parametrize(
    ("alpha", "memory"),
    [
        ("123456789/987654321987", "refuted"),
        ("987654321986/987654321987", "proved"),
        ("18446744073709551617/36893488147419103232", ""),
    ],
)
def test_an_order_of_long_numbers_is_decided_or_refused(
    verify: Verify, tmp_path: Path, alpha: str, memory: str
) -> None:
    """mu = 1/10 on a cycle of five: 1 - mu lambda2 = 0.86 lies between 2^alpha - 1 near 0 and near 1."""
    design = write(
        tmp_path, f'alpha = "{alpha}"\nmu = 0.1\nx0 = [1, 2, 3, 4, 5]\n[graph]\nfamily = "cycle"\nagents = 5\n'
    )
    run = verify("prove", design, "-o", tmp_path / "certificate.json")
    if not memory:
        assert (run.returncode, run.stdout, run.stderr.count("\n")) == (2, "", 1)
        return
    assert "undecided" not in run.stdout
    assert re.search(rf"^[* ] memory-inequality +{memory} ", run.stdout, re.M)
    assert run.returncode == (0 if memory == "proved" else 1)
    assert verify("check", tmp_path / "certificate.json", "--design", design).returncode == 0
