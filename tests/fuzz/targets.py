"""What is fuzzed: each target takes bytes to a verdict or a one-line refusal; whatever else it does is a failure."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Callable
from hashlib import sha256
from pathlib import Path
from random import Random
from xml.etree import ElementTree

from fomas_verify.checker import Malformed, check
from fomas_verify.design import AnyDesign, Design, LargeDesign, SwitchedDesign, UncertainDesign, read_named
from fomas_verify.exact.errors import FomasError

from .mutate import NUMBERS, TEXTS, mutate, mutate_packed
from .seeds import SMALL, graph_seeds, seeds

VERDICT, REFUSAL = "verdict", "refusal"
LONGEST = 1000
MOST_AGENTS = 12
"""Agents up to which a design that was read is decided too."""

MOST_SAMPLES = 10_000


def draw(target: str, seed: int, index: int) -> bytes:
    """The input with this number."""
    random = Random(f"{target} {seed} {index}")
    if target == "graph":
        return _graph(random)
    kind = target if target in ("certificate", "grid") else "design"
    known = SMALL if target in ("prove", "report") else seeds(kind)
    data, other = random.choice(known), random.choice(known)
    if target == "report" and random.random() < 0.7:
        name = "".join(random.choice(TEXTS + NUMBERS + list("aZ%$_^~\\{}<>|&# ")) for _ in range(random.randint(1, 6)))
        return json.dumps(
            {
                "name": name[:200],
                "alpha": "9/10",
                "mu": random.choice(("1/5", "0.3", "2")),
                "gate": {"require": ["gain-bound"]},
                "graph": {"family": "directed-cycle", "agents": 3},
            }
        ).encode()
    return data if random.random() < 0.02 else mutate(data, other, random)


def _graph(random: Random) -> bytes:
    """A graph file behind a line that holds its ending and orientation."""
    ending, data = random.choice(graph_seeds())
    other = random.choice(graph_seeds())[1]
    data = (mutate_packed if ending in (".npz", ".mat") else mutate)(data, other, random)
    ending = ending if random.random() < 0.97 else random.choice((".csv", ".mtx", ".mat", ".npz", ".graphml"))
    return f"{ending} {random.choice(('hears', 'hears', 'from-to', 'both-ways', ''))}\n".encode() + data


def fuzz_graph(data: bytes, folder: Path) -> str:
    """Reading a graph file; the input's first line is the file's ending and the orientation, or there is no file."""
    from fomas_verify.network import GraphError
    from fomas_verify.network.files import read_graph_file

    head = re.match(rb"(\.[a-z]+) ([a-z-]*)\n", data)
    if head is None:
        return REFUSAL
    ending, orientation = (word.decode() for word in head.groups())
    file = folder / f"graph{ending}"
    file.write_bytes(data[head.end() :])
    try:
        found = read_graph_file(file, orientation or None, name="graph")
    except (GraphError, FomasError) as error:
        return _one_line(str(error))
    for remark in found.remarks:
        _one_line(remark)
    return VERDICT


def fuzz_grid(data: bytes, folder: Path) -> str:
    """Reading a grid, and its first design on each of the first graphs."""
    from fomas_verify.sweep.grid import read_grid

    file = folder / ("grid.json" if data.lstrip()[:1] == b"{" else "grid.toml")
    file.write_bytes(data)
    try:
        grid = read_grid(file)
    except FomasError as error:
        return _refused(error, (2,))
    for graph in range(min(3, len(grid.graphs))):
        try:
            grid.design_on(graph)
        except FomasError as error:
            _refused(error, (2,))
    return VERDICT


def fuzz_design(data: bytes, folder: Path) -> str:
    """Reading a design file, named .toml, .json or neither."""
    named = _read(data, folder)
    if isinstance(named, str):
        return named
    from fomas_verify.certificate.document import design_object
    from fomas_verify.certificate.large_document import graph_entry, large_design_object

    large = isinstance(named, LargeDesign)
    json.dumps(large_design_object(named, graph_entry(named.graph, "c.json")) if large else design_object(named))
    return VERDICT


def fuzz_prove(data: bytes, folder: Path) -> str:
    """Reading a design and deciding it; the checker must accept what the prover wrote."""
    named = _read(data, folder)
    if isinstance(named, str):
        return named
    if not _is_small(named):
        return VERDICT
    try:
        certificate = _certificate(named)
    except FomasError as error:
        return _refused(error, (2, 3))
    refused = [f"{x.id}: {x.reason}" for x in check(certificate.encode()).outcomes if x.status == "refused"]
    if refused:
        raise AssertionError(f"the checker refuses the prover's certificate: {refused}")
    return VERDICT


def _certificate(named: AnyDesign) -> str:
    from fomas_verify.prover import prove, prove_large, prove_uncertain
    from fomas_verify.region.switching import prove_switched

    if isinstance(named, Design):
        return prove(named).certificate()
    if isinstance(named, LargeDesign):
        return prove_large(named).certificate("c.json")
    return (prove_uncertain(named) if isinstance(named, UncertainDesign) else prove_switched(named)).certificate()


def fuzz_certificate(data: bytes, folder: Path) -> str:
    """The checker."""
    try:
        report = check(data)
    except Malformed as error:
        return _one_line(str(error))
    for outcome in report.outcomes:
        _one_line(outcome.reason)
    return VERDICT


def fuzz_gate(data: bytes, folder: Path) -> str:
    """The gate over a folder that holds the input under several names, with every report it can write."""
    from fomas_verify.gate.deciding import Options
    from fomas_verify.gate.discovery import find_designs
    from fomas_verify.gate.junit import junit_xml
    from fomas_verify.gate.markdown import markdown_text
    from fomas_verify.gate.record import annotation_lines, gate_json
    from fomas_verify.gate.run import run_gate
    from fomas_verify.gate.sarif import sarif_json

    room = folder / "gate"
    room.mkdir(exist_ok=True)
    for name in ("a.design.toml", "b.json", "c.toml"):
        (room / name).write_bytes(data)
    found = [x for x in find_designs([room]) if not (isinstance(x, Path) and _is_large(x))]
    answer = run_gate(found, Options(("gain-bound",)), 1, lambda _: None)
    for result in answer.results:
        for finding in result.findings:
            _one_line(finding.reason)
    ElementTree.fromstring(junit_xml(answer))
    json.loads(sarif_json(answer))
    json.loads(gate_json(answer))
    markdown_text(answer).decode()
    if any("\n" in line for line in annotation_lines(answer)):
        raise AssertionError("an annotation of several lines")
    if answer.status == 4:
        raise AssertionError(f"internal error: {[x.reason for r in answer.results for x in r.findings]}")
    return VERDICT if any(result.status != 2 for result in answer.results) else REFUSAL


def fuzz_report(data: bytes, folder: Path) -> str:
    """The report's three sources; every 200th LaTeX is typeset where a LaTeX is at hand."""
    from fomas_verify.prover import prove
    from fomas_verify.report.checked import checked
    from fomas_verify.report.compilation import NO_LATEX, compile_latex
    from fomas_verify.report.model import report_model
    from fomas_verify.report.rendering import render

    named = _read(data, folder)
    if isinstance(named, str):
        return named
    if not isinstance(named, Design) or not _is_small(named):
        return VERDICT
    try:
        proof = prove(named)
        certificate = proof.certificate()
        model = report_model(proof, certificate, checked(certificate), "verify-design report x")
        latex, html, _ = (render([model], form) for form in ("latex", "html", "md"))
    except FomasError as error:
        return _refused(error, (2, 3))
    latex.encode("ascii")
    if "<script" in html or "<iframe" in html:
        raise AssertionError("the HTML page holds markup of the design")
    if sha256(data).digest()[0] == 0 and os.environ.get("FUZZ_LATEX", "1") == "1":
        made = compile_latex(latex, {t.file: t.csv() for t in model.tables})
        if made.pdf is None and made.reason != NO_LATEX:
            raise AssertionError(made.reason)
    return VERDICT


TARGETS: dict[str, Callable[[bytes, Path], str]] = {
    "design": fuzz_design,
    "graph": fuzz_graph,
    "grid": fuzz_grid,
    "certificate": fuzz_certificate,
    "gate": fuzz_gate,
    "prove": fuzz_prove,
    "report": fuzz_report,
}


def _read(data: bytes, folder: Path) -> AnyDesign | str:
    ending = ".json" if data.lstrip()[:1] == b"{" else ".toml"
    file = folder / ("input" if sha256(data).digest()[1] < 16 else f"input{ending}")
    file.write_bytes(data)
    try:
        return read_named(file)
    except FomasError as error:
        return _refused(error, (2,))


def _plain(named: AnyDesign) -> Design | LargeDesign:
    if isinstance(named, UncertainDesign):
        return named.least
    return named.first if isinstance(named, SwitchedDesign) else named


def _is_small(named: AnyDesign) -> bool:
    plain = _plain(named)
    cheap = plain.graph.agents <= MOST_AGENTS or (isinstance(plain, LargeDesign) and plain.graph.known_family)
    return bool(cheap) and (plain.horizon or 0) <= MOST_SAMPLES


def _is_large(path: Path) -> bool:
    try:
        return not _is_small(read_named(path))
    except FomasError:
        return False


def _refused(error: FomasError, statuses: tuple[int, ...]) -> str:
    if error.exit_status not in statuses:
        raise AssertionError(f"exit status {error.exit_status}: {error}")
    return _one_line(str(error))


def _one_line(message: str) -> str:
    if not message.isprintable() or not 0 < len(message) <= LONGEST:
        raise AssertionError(f"no refusal in one line: {message[:200]!r} ({len(message)} characters)")
    return REFUSAL
