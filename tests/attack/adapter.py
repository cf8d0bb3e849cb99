"""The only door from the attack to prover and checker: their one function each, and their command line.

`prove` and `check_status` ask in this process, `command_line_proof` and `command_line_status` in one of their own.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import traceback
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


@dataclass(frozen=True)
class Proof:
    """What a run of `prove` gave: exit status, certificate (empty if none was written), standard error."""

    status: int
    certificate: bytes
    errors: str


def _run(arguments: list[str]) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    return subprocess.run(
        [sys.executable, *arguments], capture_output=True, text=True, check=False, env=environment, timeout=600
    )


def prove(design: dict[str, object]) -> Proof:
    """What `verify-design prove` does with a design, in this process; 4 where the prover raises what it must not."""
    from fomas_verify.design import Design, read_any
    from fomas_verify.exact.errors import FomasError
    from fomas_verify.prover import prove as decide
    from fomas_verify.prover import prove_uncertain

    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder, "design.json")
        source.write_text(json.dumps(design), encoding="utf-8")
        try:
            read = read_any(source)
            proof = decide(read) if isinstance(read, Design) else prove_uncertain(read)
            return Proof(proof.exit_status, proof.certificate().encode(), "")
        except FomasError as error:
            return Proof(error.exit_status, b"", str(error))
        except Exception:
            return Proof(4, b"", traceback.format_exc())


def command_line_proof(design: dict[str, object]) -> Proof:
    """Run `verify-design prove` on a design in a process of its own."""
    with tempfile.TemporaryDirectory() as folder:
        source, target = Path(folder, "design.json"), Path(folder, "certificate.json")
        source.write_text(json.dumps(design), encoding="utf-8")
        run = _run(["-m", "fomas_verify", "prove", str(source), "-o", str(target)])
        return Proof(run.returncode, target.read_bytes() if target.exists() else b"", run.stderr)


def prove_json(design: dict[str, object]) -> bytes:
    """The certificate that `prove` writes for a design.

    Raises
    ------
    RuntimeError
        When no certificate was written.
    """
    proof = prove(design)
    if not proof.certificate:
        raise RuntimeError(f"prove exited {proof.status} without a certificate: {proof.errors}")
    return proof.certificate


def region_certificate(mapping: dict[str, object]) -> bytes:
    """What `verify-design region -o` writes for a design."""
    from fomas_verify.design import design_from_mapping
    from fomas_verify.region import certificate, find_region

    return certificate(find_region(design_from_mapping(mapping))).encode()


def synthesis_certificate(mapping: dict[str, object], objective: str, condition: str) -> bytes:
    """What `verify-design synthesize --direct -o` writes for a design, in a process of its own."""
    with tempfile.TemporaryDirectory() as folder:
        source, target = Path(folder, "design.json"), Path(folder, "best.toml")
        source.write_text(json.dumps(mapping), encoding="utf-8")
        options = ["--objective", objective, "--condition", condition, "--direct", "-o", str(target)]
        run = _run(["-m", "fomas_verify", "synthesize", str(source), *options])
        written = target.with_suffix(".json")
        if not written.exists():
            raise RuntimeError(f"synthesize exited {run.returncode} without a certificate: {run.stderr}")
        return written.read_bytes()


def coq_text(mapping: dict[str, object]) -> str:
    """The Coq file that `verify-design prove --coq` writes for a design."""
    from fomas_verify.certificate.coq import coq_file
    from fomas_verify.design import design_from_mapping
    from fomas_verify.prover import prove as decide

    proof = decide(design_from_mapping(mapping))
    return coq_file(proof.loop, proof.decisions).text


def check_status(certificate: bytes) -> int:
    """The exit status `check` deserves on these bytes; 4 where the checker raises what it must not."""
    from fomas_verify.checker import Malformed, check

    try:
        return int(check(certificate).exit_status)
    except Malformed:
        return 2
    except Exception:
        return 4


def command_line_status(certificate: bytes) -> tuple[int, str]:
    """Exit status and output of `python -I -S fomas_verify/checker FILE`."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "certificate.json")
        path.write_bytes(certificate)
        run = _run(["-I", "-S", str(ROOT / "fomas_verify" / "checker"), str(path)])
        return run.returncode, run.stdout + run.stderr
