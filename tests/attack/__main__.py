"""The attack at any size: `python -m tests.attack --mutants 100000 --designs 10000`.

`--kinds`, `--switched` and `--large` are the numbers of mutants of certificates of regions and syntheses, of graphs to
switch among, and of large networks. Prints the figures and exits 1 if a false certificate was accepted, a verdict was
wrong, fewer than 95 % of the true mutants were accepted, or 1 % of the verdicts or more were left undecided.
"""

from __future__ import annotations

import argparse
import multiprocessing
import sys
from collections import Counter
from collections.abc import Iterable
from functools import partial

from . import handmade_family, kinds, large, switched_truth
from .conftest import WITH_MARGINS
from .designs import FAMILIES, NAMED
from .differential import Comparison, compare
from .duel import Score, duel, unacceptable
from .family_differential import compare_family
from .family_strata import family_at
from .handmade import certificate
from .handmade_margins import margins
from .mutants import mutants, sweep
from .oracle import CLAIMS
from .strata import design_at
from .tally import Tally

CHUNK = 250


def _designs(seed: int, index: int) -> Comparison:
    uncertain = index % 8 == 7
    name, design = family_at(seed, index // 8) if uncertain else design_at(seed, index - index // 8)
    try:
        return compare_family(name, design) if uncertain else compare(name, design)
    except Exception as error:
        return Comparison(name, design, (f"the comparison failed: {type(error).__name__}: {error}",), 0, b"")


def _mutants(golden: dict[str, bytes], seed: int, count: int, start: int) -> Score:
    return duel(mutants(golden, seed, min(CHUNK, count - start), start))


def _fields(certificate: tuple[str, bytes]) -> Score:
    return duel(sweep(*certificate))


def _golden() -> dict[str, bytes]:
    named = {name: compare(name, design).certificate for name, design in NAMED.items()}
    handmade = {f"{name}, by hand": certificate(design) for name, design in NAMED.items()}
    further = {f"{name}, margins": certificate(NAMED[name], margins(NAMED[name])) for name in WITH_MARGINS}
    further |= {name: handmade_family.certificate(family) for name, family in FAMILIES.items()}
    further |= {f"{name}, proved": compare_family(name, family).certificate for name, family in FAMILIES.items()}
    return {name: data for name, data in {**named, **handmade, **further}.items() if data}


def attack_prover(pool: multiprocessing.pool.Pool, seed: int, count: int) -> bool:
    """Random designs, one in eight of them uncertain, through prover, checker and oracle; whether all is well."""
    faults, undecided = [], 0
    for comparison in pool.imap_unordered(partial(_designs, seed), range(count), chunksize=4):
        undecided += comparison.undecided
        faults += [f"{comparison.name}: {fault}\n  {comparison.design}" for fault in comparison.faults]
    print(*faults, sep="\n")
    share = undecided / (len(CLAIMS) * count)
    print(f"designs: {count}, disagreements: {len(faults)}, undecided claims: {undecided} ({share:.3%})")
    return not faults and share < 0.01


def attack_checker(scores: Iterable[Score]) -> bool:
    """Print what came of mutants of golden certificates; whether all is well."""
    total = Score(Counter())
    for score in scores:
        total.add(score)
    faults = unacceptable(total)
    print(*faults, sep="\n")
    for word in ("true", "false", "malformed", "unknown"):
        print(f"{word} mutants: {total.total(word)}, accepted: {total.accepted(word)}")
    for word, status, mutant in total.wrong:
        if word == "true":
            print(f"true, but answered {status}: {mutant.label}")
    return not faults and total.accepted("true") >= 0.95 * total.total("true")


def attack_kind(name: str, tallies: Iterable[Tally]) -> bool:
    """Print what came of mutants of another kind of certificate; whether all is well."""
    total = Tally()
    for tally in tallies:
        total.add(tally)
    for fault in total.faults:
        print(fault)
    print(
        f"{name}: {total.mutants} mutants, {total.accepted} accepted, {total.refused} refused, {total.malformed} "
        f"malformed, {total.true_accepted} of {total.true} true ones accepted, false ones accepted: {len(total.faults)}"
    )
    return total.stood


def _of_kinds(golden: dict[str, bytes], seed: int, count: int, start: int) -> Tally:
    return kinds.attack(golden, seed, min(CHUNK, count - start), start)


def _of_switched(seed: int, count: int, start: int) -> Tally:
    return switched_truth.attack(seed, min(CHUNK, count - start), start)


def _of_large(golden: dict[str, bytes], seed: int, count: int, start: int) -> Tally:
    return large.attack(golden, seed, min(CHUNK, count - start), start)


def main(arguments: list[str]) -> int:
    """Run the attack; 0 if prover and checker stood it."""
    parser = argparse.ArgumentParser(prog="python -m tests.attack", description=__doc__)
    parser.add_argument("--mutants", type=int, default=2000)
    parser.add_argument("--designs", type=int, default=300)
    parser.add_argument("--kinds", type=int, default=0)
    parser.add_argument("--switched", type=int, default=0)
    parser.add_argument("--large", type=int, default=0)
    parser.add_argument("--fields", action="store_true", help="also every edit of every field of each certificate")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=multiprocessing.cpu_count())
    given = parser.parse_args(arguments)
    with multiprocessing.Pool(given.jobs) as pool:
        well = [attack_prover(pool, given.seed, given.designs)] if given.designs else []
        if given.mutants:
            drawn = partial(_mutants, _golden(), given.seed, given.mutants)
            well.append(attack_checker(pool.imap_unordered(drawn, range(0, given.mutants, CHUNK))))
        if given.fields:
            well.append(attack_checker(pool.imap_unordered(_fields, _golden().items())))
        if given.kinds:
            made = partial(_of_kinds, kinds.golden(), given.seed, given.kinds)
            well.append(attack_kind("regions and syntheses", pool.imap_unordered(made, range(0, given.kinds, CHUNK))))
        if given.switched:
            drawn_switched = partial(_of_switched, given.seed, given.switched)
            chunks = range(0, given.switched, CHUNK)
            well.append(attack_kind("graphs to switch among", pool.imap_unordered(drawn_switched, chunks)))
        if given.large:
            drawn_large = partial(_of_large, large.golden(), given.seed, given.large)
            chunks = range(0, given.large, CHUNK)
            well.append(attack_kind("large networks", pool.imap_unordered(drawn_large, chunks)))
    return 0 if all(well) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
