"""The fuzzer led by coverage: `make .venv/guided.done`, then `python -m tests.fuzz.guided TARGET -max_total_time=600`.

atheris makes the inputs, from those of `draw`, by which branches of the package they reach. One that a target does not
answer with a verdict or a refusal ends the run, and libFuzzer says where it keeps it.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import atheris

with atheris.instrument_imports(include=["fomas_verify"]):
    from .targets import TARGETS, draw

SEEDS = 200
LIMITS = ("-timeout=10", "-rss_limit_mb=1200")


def main(target: str, *options: str) -> None:
    """Run until one of libFuzzer's options ends it."""
    with tempfile.TemporaryDirectory() as name:
        corpus, folder = Path(name, "corpus"), Path(name, "work")
        corpus.mkdir()
        folder.mkdir()
        with atheris.instrument_imports(include=["fomas_verify"]):  # of what is imported late, too
            for index in range(SEEDS):
                data = draw(target, 1, index)
                TARGETS[target](data, folder)
                (corpus / str(index)).write_bytes(data)

        def one(data: bytes) -> None:
            TARGETS[target](data, folder)

        atheris.Setup(["guided", *LIMITS, *options, str(corpus)], one)
        atheris.Fuzz()


if __name__ == "__main__":
    main(*sys.argv[1:])
