"""`python -m tests.mutation [MODULE...]`: each mutant of the checker's source is killed, or its survival explained.

Needs cosmic-ray beside the development dependencies. Prints the figures by module, every survivor that
`survivors.toml` does not explain, and every one it explains that did not survive; exits 1 if there is one of the first.
`__main__.py` is not among the modules: it runs in processes of its own, which see no mutation.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections import Counter
from pathlib import Path

import pytest

from .duel import Duel, Fate
from .mutations import Mutation, mutations, sample
from .survivors import FILE, survivors
from .transplant import CHECKER

HERE = Path(__file__).resolve().parent
TESTS = (HERE.parent / "checker", HERE / "curated_certificates.py")
# They start processes, which do not see a mutation, or are slow and say no more than their neighbours at fewer bits.
LEFT_OUT = ("every_way", "another_folder", "closed_pipe", "failed_import", "as_a_folder", "imported_it",
            "whatever_else", "encloses and 512", "many_agents_where_little")  # fmt: skip
PLUGINS = ("cacheprovider", "cov", "xdist", "unraisableexception", "threadexception")
Key = tuple[str, str, str, str]


def fight(mutants: list[Mutation], jobs: int) -> list[Fate]:
    """Every mutant against the tests."""
    duel = Duel(mutants, jobs)
    without = [argument for name in PLUGINS for argument in ("-p", f"no:{name}")]
    selected = " and ".join(f"not ({words})" for words in LEFT_OUT)
    status = pytest.main([*without, "-q", "-k", selected, *map(str, TESTS)], plugins=[duel])
    if status != pytest.ExitCode.OK:
        raise SystemExit(int(status))
    return duel.fates


def told(fates: list[Fate]) -> bool:
    """Print what came of it; whether every survivor is explained."""
    words = ("killed", "timed out", "survived")
    counts = Counter((fate.mutation.module, fate.word) for fate in fates)
    for module in sorted({fate.mutation.module for fate in fates}):
        print(module, *(f"{counts[module, word]} {word}" for word in words), sep=", ")
    print(f"{len(fates)} mutants", *(f"{sum(f.word == word for f in fates)} {word}" for word in words), sep=", ")
    explained: set[Key] = {
        (entry.module, entry.function, entry.line, mutant)
        for entry in survivors(FILE.read_text("utf-8"))
        for mutant in entry.mutants
    }
    survived = {fate.mutation.key for fate in fates if fate.word == "survived"}
    for label, keys in (
        ("not explained", survived - explained),
        ("explained, but dead", explained & {fate.mutation.key for fate in fates} - survived),
    ):
        for module, function, before, after in sorted(keys):
            print(f"{label}: {module}.{function}\n  {before}\n  {after}")
    return survived <= explained


def main(arguments: list[str]) -> int:
    """Mutate and tell; 0 if every survivor is explained."""
    names = sorted(path.stem for path in CHECKER.glob("*.py") if not path.stem.startswith("__"))
    parser = argparse.ArgumentParser(prog="python -m tests.mutation", description=__doc__)
    parser.add_argument("modules", nargs="*", default=names, metavar="MODULE")
    parser.add_argument("--every", type=int, default=1, help="each N-th mutant, and the first of each function")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    given = parser.parse_args(arguments)
    mutants = [m for name in given.modules for m in sample(mutations(CHECKER / f"{name}.py"), given.every)]
    return 0 if told(fight(mutants, given.jobs)) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
