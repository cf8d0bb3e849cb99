"""Coq files of designs with one number changed, put to coqc: what it accepts must be true of the design in the file.

`python -m tests.attack.coq_mutants --mutants 200` needs coqc and the compiled folder proofs/. The design is read from
the definitions at the head of the file and judged by the oracle.
"""

from __future__ import annotations

import argparse
import multiprocessing
import re
import subprocess
import sys
import tempfile
from fractions import Fraction
from functools import partial
from pathlib import Path
from random import Random

from . import oracle
from .adapter import ROOT, coq_text
from .designs import NAMED
from .model import Design
from .tally import Tally

BASES = ("paper", "c4-third", "unbalanced", "paper-repaired", "k5-negative-beta")
NUMBER = re.compile(r"(?<![\w.])-?\d+(?![\w.])")
COMMENT = re.compile(r"\(\*.*?\*\)", re.DOTALL)
SAID = re.compile(r"^  \(\* ([a-z-]+): (proved|refuted|inapplicable) \*\)$", re.MULTILINE)


def mutated(text: str, random: Random) -> str:
    """The file with one number outside of its comments changed, or two exchanged."""
    hidden = [match.span() for match in COMMENT.finditer(text)]
    numbers = [m for m in NUMBER.finditer(text) if not any(a <= m.start() < b for a, b in hidden)]
    one = random.choice(numbers)
    if random.random() < 0.2:
        other = random.choice(numbers)
        first, second = sorted((one, other), key=lambda match: match.start())
        if first.end() <= second.start():
            middle = text[first.end() : second.start()]
            return text[: first.start()] + second.group() + middle + first.group() + text[second.end() :]
    x = int(one.group())
    new = random.choice((x + 1, x - 1, -x, 10 * x, 2 * x, x + x // 1000 + 1, x - x // 1000 - 1, 0))
    return text[: one.start()] + str(new) + text[one.end() :]


def _rational(text: str, name: str) -> Fraction | None:
    found = re.search(rf"Definition {name} : R := (-?\d+)(?: / (-?\d+))?\.", text)
    return None if found is None else Fraction(int(found.group(1)), int(found.group(2) or 1))


def design_in(text: str) -> Design | None:
    """The design that the file is about; None where its numbers are no design's."""
    agents = int(re.search(r"Definition agents : nat := (-?\d+)\.", text).group(1))
    rows = re.search(r"Definition weights : zmat := \[(.*?)\]%Z\.", text, re.DOTALL).group(1)
    weights = [[int(x) for x in row.split(";")] for row in re.findall(r"\[([^\]]*)\]", rows)]
    denominator = int(re.search(r"Definition denominator : Z := (-?\d+)\.", text).group(1))
    alpha, mu, gamma, h = (_rational(text, name) for name in ("alpha", "mu", "gamma", "h"))
    start = re.search(r"\(trajectory_norm_bound agents graph alpha gamma h \[([^\]]*)\]%Z (-?\d+)\)", text)
    off = any(x and i == j for i, row in enumerate(weights) for j, x in enumerate(row))
    shape = {len(weights), *map(len, weights)} == {agents}
    if off or not shape or denominator < 1 or min(min(row) for row in weights) < 0 or alpha is None:
        return None
    edges = tuple(
        (j + 1, i + 1, Fraction(x, denominator)) for i, row in enumerate(weights) for j, x in enumerate(row) if x
    )
    x0 = None
    if start is not None and int(start.group(2)):
        x0 = tuple(Fraction(int(x), int(start.group(2))) for x in start.group(1).split(";"))
    return Design(alpha, agents, edges, mu=mu, gamma=None if mu is not None else gamma, h=h, x0=x0)


def wrong(text: str) -> list[str]:
    """What an accepted file says of its design against the oracle; nothing where its matrix is that of no digraph."""
    design = design_in(text)
    if design is None:
        return []
    faults = []
    for claim, verdict in SAID.findall(text):
        truth = oracle.verdict(design, claim)
        if truth is not None and truth != verdict:
            faults.append(f"{claim} {verdict}, the oracle says {truth}")
    return faults


def accepts(text: str, proofs: Path = ROOT / "proofs") -> bool:
    """Whether coqc accepts a file."""
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "Mutant.v").write_text(text)
        command = ["coqc", "-R", str(proofs), "Fomas", "-w", "-ambiguous-paths", "Mutant.v"]
        try:
            return subprocess.run(command, cwd=folder, capture_output=True, check=False, timeout=300).returncode == 0
        except subprocess.TimeoutExpired:
            return False


def attack(texts: dict[str, str], seed: int, index: int) -> Tally:
    """The mutant with this index, judged."""
    random, tally = Random(f"coq {seed}/{index}"), Tally(mutants=1)
    name = random.choice(sorted(texts))
    text = mutated(texts[name], random)
    if accepts(text):
        tally.accepted = 1
        tally.faults = [f"{name} {seed}/{index}: {fault}" for fault in wrong(text)]
    else:
        tally.refused = 1
    return tally


def texts() -> dict[str, str]:
    """The files of the bases."""
    return {name: coq_text(NAMED[name].mapping(name)) for name in BASES}


def main(arguments: list[str]) -> int:
    """Run the attack; 0 if Coq accepted nothing false."""
    parser = argparse.ArgumentParser(prog="python -m tests.attack.coq_mutants", description=__doc__)
    parser.add_argument("--mutants", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=multiprocessing.cpu_count())
    given = parser.parse_args(arguments)
    total = Tally()
    with multiprocessing.Pool(given.jobs) as pool:
        for tally in pool.imap_unordered(partial(attack, texts(), given.seed), range(given.mutants)):
            total.add(tally)
    for fault in total.faults:
        print(fault)
    print(
        f"Coq files: {total.mutants} mutants, {total.refused} refused by coqc, {total.accepted} accepted, "
        f"false ones accepted: {len(total.faults)}"
    )
    return 0 if total.stood else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
