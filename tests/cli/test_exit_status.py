"""Every exit status of every command, each produced by a call of the real entry point.

Status 4 comes from an injected disagreement: two computations that must agree are made to differ before the command
runs, in a process of its own.
"""

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from fomas_verify._entry import main
from fomas_verify.cli.app import COMMANDS

FILES = {
    "good.toml": 'name = "good"\nalpha = 0.9\nmu = 0.2\n[graph]\nfamily = "complete"\nagents = 4\n',
    "false.toml": 'name = "false"\nalpha = 0.9\nmu = 1\n[graph]\nfamily = "directed-cycle"\nagents = 5\n',
    "large.toml": 'name = "large"\nalpha = 0.9\nmu = 0.1\n[graph]\nfamily = "cycle"\nagents = 201\n',
    "open.toml": 'name = "open"\nalpha = 0.99985\nmu = 0.5\n[graph]\nfamily = "directed-cycle"\nagents = 201\n'
    '[gate]\nrequire = ["control-norm-bound"]\n',
    "start.toml": 'alpha = 0.9\ngamma = 0.2\nh = 0.85\nx0 = [1, 2, 4]\n[graph]\nfamily = "complete"\nagents = 3\n',
    "shut.toml": 'alpha = 0.5\n[graph]\nfamily = "directed-cycle"\nagents = 5\n',
    "steps.toml": 'gate.require = ["beta-contraction"]\nalpha = 0.9\ngraph = {family = "directed-cycle", agents = 3}\n',
    "grid.toml": 'mu = 0.2\n[graph]\nfamily = "complete"\nagents = 3\n[grid]\nalpha = [0.5, 0.9]\n',
    "broken.toml": "alpha = 2\n",
    "broken.json": "{",
    "designs/a.design.toml": 'name = "a"\nalpha = 0.9\nmu = 0.2\n[graph]\nfamily = "complete"\nagents = 4\n',
}
ENTRY = """
import sys
from fractions import Fraction
from importlib import import_module
{}
sys.argv[0] = "verify-design"
from fomas_verify._entry import main
main()
"""
THRESHOLD = (
    "import_module('fomas_verify.prover.prove').approx_gain_and_threshold = lambda *a: {'threshold': Fraction(1, 2)}"
)
MEMORY = "import_module('fomas_verify.kernel.table').approx_memory = lambda *a: (Fraction(-1, 2), Fraction(1, 2))"
NEGATION = "import_module('fomas_verify.cli.selftest').PRIMITIVES = (lambda: False,)"
LIMIT = """from dataclasses import replace
simulate = import_module('fomas_verify.cli.simulate')
known = simulate.certified_of
simulate.certified_of = lambda d: replace(known(d), bounds=replace(known(d).bounds, limit=(Fraction(9),)))"""
CRASH = "def crash(*a, **k): raise ZeroDivisionError\n"
REGION = CRASH + "import_module('fomas_verify.cli.region').find_region = crash"
CHECK = CRASH + "import_module('fomas_verify.gate.answer').check = crash"
SYNTHESIZE = CRASH + "import_module('fomas_verify.api.synthesizing').synthesize = crash"
REFUSAL = """tasks = import_module('fomas_verify.checker.tasks')
def refuse(*a): raise import_module('fomas_verify.checker.ruling').Refused('no')
import_module('fomas_verify.checker.report').require_task_claim = refuse"""
SWEEP = CRASH + "import_module('fomas_verify.sweep.plan').make_plan = crash"
INIT = CRASH + "import_module('fomas_verify.cli.init').write_whole = crash"
SCHEMA = CRASH + "import_module('fomas_verify.cli.schema').files = crash"
COMPLETION = CRASH + "import_module('fomas_verify.cli.completion').get_completion_class = crash"
INTERRUPT = "def stop(*a, **k): raise KeyboardInterrupt\nimport_module('fomas_verify.{0}').{1} = stop"

# command -> status -> calls, each with what is injected
TABLE: dict[str, dict[int, list[tuple[str, str]]]] = {
    "prove": {
        0: [("prove good.toml", ""), ("prove good.toml --json", "")],
        1: [("prove false.toml", ""), ("prove false.toml -o out.json", "")],
        2: [("prove broken.toml", ""), ("prove", ""), ("prove good.toml -o no/where.json", "")],
        3: [("prove open.toml", ""), ("prove open.toml -o out.json", "")],
        4: [("prove good.toml", THRESHOLD)],
        130: [("prove good.toml", INTERRUPT.format("cli.prove", "prove"))],
    },
    "check": {
        0: [
            ("check good.json", ""),
            ("check false.json", ""),
            ("check good.json --design good.toml --require design", ""),
        ],
        1: [
            ("check lie.json", ""),
            ("check false.json --require design", ""),
            ("check good.json --design false.toml", ""),
        ],
        2: [("check broken.json", ""), ("check missing", ""), ("check good.json --require x", ""), ("check", "")],
        3: [("check open.json --require gain-bound", "")],
        4: [("check good.json", CHECK)],
        130: [("check good.json", INTERRUPT.format("gate.answer", "check"))],
    },
    "kernel": {
        0: [("kernel good.toml", ""), ("kernel false.toml --json", "")],
        2: [("kernel broken.toml", ""), ("kernel good.toml --at 0", "")],
        4: [("kernel good.toml", MEMORY)],
        130: [("kernel good.toml", INTERRUPT.format("cli.kernel", "kernel_rows"))],
    },
    "region": {
        0: [("region start.toml", ""), ("region false.toml --json", ""), ("region good.toml -o region.json", "")],
        2: [("region broken.toml", ""), ("region good.toml -o no/where.json", ""), ("region", "")],
        3: [("region large.toml", "")],
        4: [("region good.toml", REGION)],
        130: [("region good.toml", INTERRUPT.format("cli.region", "find_region"))],
    },
    "synthesize": {
        0: [("synthesize good.toml --direct", ""), ("synthesize start.toml --direct --json -o found", "")],
        1: [("synthesize shut.toml", ""), ("synthesize shut.toml --json -o none", "")],
        2: [
            ("synthesize broken.toml", ""),
            ("synthesize", ""),
            ("synthesize good.toml --objective best", ""),
            ("synthesize good.toml --condition whole", ""),
            ("synthesize good.toml --objective fastest", ""),
            ("synthesize good.toml --direct -o found.txt", ""),
            ("synthesize good.toml --direct -o no/where.toml", ""),
        ],
        3: [("synthesize large.toml", ""), ("synthesize steps.toml --direct", "")],
        4: [("synthesize good.toml --direct", SYNTHESIZE), ("synthesize good.toml --direct -o bad", REFUSAL)],
        130: [("synthesize good.toml", INTERRUPT.format("api.synthesizing", "find_region"))],
    },
    "simulate": {
        0: [("simulate start.toml --samples 3", ""), ("simulate start.toml --samples 3 --json", "")],
        2: [("simulate good.toml", ""), ("simulate start.toml --csv no/where.csv", ""), ("simulate", "")],
        4: [("simulate start.toml --samples 3", LIMIT)],
        130: [("simulate start.toml", INTERRUPT.format("cli.simulate", "certified_of"))],
    },
    "report": {
        0: [("report good.toml -o good", ""), ("report false.toml -o false", "")],
        2: [("report broken.toml -o out", ""), ("report good.toml -o good.toml", "")],
        3: [("report large.toml -o out", "")],
        4: [("report good.toml -o out", THRESHOLD)],
        130: [("report good.toml -o out", INTERRUPT.format("cli.report", "prove"))],
    },
    "gate": {
        0: [("gate designs", ""), ("gate good.toml --json", "")],
        1: [("gate good.toml -j 1 false.toml open.toml broken.toml", "")],
        2: [
            ("gate -j 1 good.toml open.toml broken.toml", ""),
            ("gate empty", ""),
            ("gate", ""),
            ("gate designs --sarif no/x", ""),
        ],
        3: [("gate -j 1 good.toml open.toml", "")],
        4: [("gate false.toml good.toml broken.toml", THRESHOLD)],
        130: [("gate good.toml", INTERRUPT.format("gate.discovery", "find_designs"))],
    },
    "sweep": {
        0: [("sweep grid.toml -o rows", "")],
        2: [
            ("sweep good.toml", ""),
            ("sweep broken.toml", ""),
            ("sweep grid.toml --max-rows 1", ""),
            ("sweep grid.toml --claims x", ""),
            ("sweep", ""),
        ],
        4: [("sweep grid.toml", SWEEP)],
        130: [("sweep grid.toml", INTERRUPT.format("sweep.plan", "make_plan"))],
    },
    "init": {
        0: [("init new", "")],
        2: [("init good.toml", ""), ("init made", ""), ("init a b", "")],
        4: [("init other", INIT)],
        130: [("init other", INTERRUPT.format("cli.init", "write_whole"))],
    },
    "schema": {
        0: [("schema design", ""), ("schema certificate", ""), ("schema grid", "")],
        2: [("schema", ""), ("schema graph", "")],
        4: [("schema design", SCHEMA)],
        130: [("schema design", INTERRUPT.format("cli.schema", "files"))],
    },
    "completion": {
        0: [("completion bash", ""), ("completion zsh", ""), ("completion fish", "")],
        2: [("completion", ""), ("completion csh", "")],
        4: [("completion bash", COMPLETION)],
        130: [("completion bash", INTERRUPT.format("cli.completion", "get_completion_class"))],
    },
    "selftest": {
        0: [("selftest", ""), ("selftest --json", "")],
        2: [("selftest extra", "")],
        4: [("selftest", NEGATION), ("selftest --json", NEGATION)],
        130: [("selftest", INTERRUPT.format("cli.selftest", "check"))],
    },
}
CALLS = [
    (command, status, call, code)
    for command, statuses in TABLE.items()
    for status, calls in statuses.items()
    for call, code in calls
]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory, checkout: Path) -> Path:
    """The files that the calls are about."""
    path = tmp_path_factory.mktemp("statuses")
    for name in ("empty", "designs"):
        (path / name).mkdir()
    for name, text in FILES.items():
        (path / name).write_text(text)
    for name in ("good", "false"):
        in_process(path, checkout, f"prove {name}.toml -o {name}.json")
    good = (path / "good.json").read_text()
    statement = '"statement": "0 < mu'
    proved = f'"id": "gain-bound",\n      "verdict": "proved",\n      {statement}'
    assert proved in good
    head, _, tail = good.partition(proved)
    undecided = tail.replace('"witness": {}', '"witness": {"bits": 4096}', 1)
    (path / "open.json").write_text(head + proved.replace("proved", "undecided") + undecided)
    (path / "lie.json").write_text(head + proved.replace("proved", "refuted") + tail)
    in_process(path, checkout, "init made")
    return path


def in_process(folder: Path, checkout: Path, call: str, code: str = "") -> subprocess.CompletedProcess[str]:
    script = f"import sys; sys.path.insert(0, {str(checkout)!r})\n" + ENTRY.format(code)
    command = [sys.executable, "-c", script, *call.split()]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)


@pytest.fixture
def run(
    folder: Path, checkout: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Callable[[str, str], subprocess.CompletedProcess[str]]:
    """Make a call: in this process, where nothing is injected."""

    def call(line: str, code: str) -> subprocess.CompletedProcess[str]:
        if code:
            return in_process(folder, checkout, line, code)
        monkeypatch.chdir(folder)
        monkeypatch.setattr(sys, "argv", ["verify-design", *line.split()])
        with pytest.raises(SystemExit) as ended:
            main()
        return subprocess.CompletedProcess(line, int(str(ended.value.code)), *capsys.readouterr())

    return call


@pytest.mark.parametrize(("command", "status", "call", "code"), CALLS, ids=[f"{x[1]}: {x[2]}" for x in CALLS])
def test_the_status(folder: Path, run, command: str, status: int, call: str, code: str) -> None:
    done = run(call, code)
    assert done.returncode == status, done.stderr
    assert call.split()[0] == command
    assert "Traceback" not in done.stderr
    on_standard_output = command in ("gate", "selftest") or (command in ("check", "prove") and status in (1, 3))
    if status in (2, 3, 4) and not on_standard_output:
        assert done.stdout == ""
        assert done.stderr.startswith(("verify-design: ", "Usage: "))
    assert list(folder.rglob("*.tmp")) == []


def test_the_table_has_every_command_and_every_status() -> None:
    """0, 2, 4 and an interruption can happen to each; 1 and 3 to those that decide or check designs."""
    assert set(TABLE) == set(COMMANDS)
    deciding = {"prove": {1, 3}, "check": {1, 3}, "gate": {1, 3}, "report": {3}, "region": {3}, "synthesize": {1, 3}}
    for command, statuses in TABLE.items():
        assert set(statuses) == {0, 2, 4, 130} | deciding.get(command, set())
