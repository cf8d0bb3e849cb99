"""The changes of a source that are tried: cosmic-ray's, and three kinds of our own, of what a checker must not do.

Our own leave a statement out, round the other way, or take the other end (lower and upper, ceil and floor, min and max,
any and all).
Left alone are annotations, decorators and `strict=`, which change nothing that is computed; an arithmetic operator is
replaced by one other, not by each of cosmic-ray's eleven, most of which any test kills.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

BINARY = {"Add": "Sub", "Sub": "Add", "Mul": "Add", "Div": "Mul", "FloorDiv": "Mul", "Mod": "FloorDiv", "Pow": "Mul",
          "LShift": "RShift", "RShift": "LShift", "BitOr": "BitAnd", "BitAnd": "BitOr"}  # fmt: skip
ORDER = ("Eq", "NotEq", "Lt", "LtE", "Gt", "GtE")
OPPOSITE = {"Is": "IsNot", "IsNot": "Is"}
OPERATORS = (
    *(f"ReplaceBinaryOperator_{old}_{new}" for old, new in BINARY.items()),
    *(f"ReplaceComparisonOperator_{old}_{new}" for old in ORDER for new in ORDER if old != new),
    *(f"ReplaceComparisonOperator_{old}_{new}" for old, new in OPPOSITE.items()),
    *("ReplaceUnaryOperator_Delete_USub", "ReplaceUnaryOperator_Delete_Not", "AddNot", "NumberReplacer"),
    *("ReplaceTrueWithFalse", "ReplaceFalseWithTrue", "ReplaceAndWithOr", "ReplaceOrWithAnd"),
    *("ReplaceBreakWithContinue", "ReplaceContinueWithBreak", "ExceptionReplacer", "ZeroIterationForLoop"),
)
ENDS = {"lower": "upper", "ceil": "floor", "min": "max", "any": "all"}
ENDS |= {new: old for old, new in ENDS.items()}

Change = tuple[int, str]


@dataclass(frozen=True)
class Mutation:
    """A whole source with one change, and what names the change where lines shift: function and both wordings."""

    module: str
    function: str
    line: int
    before: str
    after: str
    source: str

    @property
    def key(self) -> tuple[str, str, str, str]:
        """What the file of survivors calls it."""
        return self.module, self.function, self.before, self.after


def mutations(path: Path) -> list[Mutation]:
    """Every mutation of a module that compiles, none twice."""
    text = path.read_text("utf-8")
    tree = ast.parse(text)
    passive = _passive_lines(tree)
    found: dict[str, Mutation] = {}
    for line, changed in (*_by_cosmic_ray(text, tree), *_by_us(text, tree)):
        if line in passive or changed == text or not _compiles(changed):
            continue
        before, after = _difference(text, changed)
        found.setdefault(changed, Mutation(path.stem, function_at(tree, line), line, before, after, changed))
    return sorted(found.values(), key=lambda mutation: mutation.line)


def sample(found: list[Mutation], every: int) -> list[Mutation]:
    """Each `every`-th mutation of a module, and the first of each of its functions."""
    first = {mutation.function: index for index, mutation in reversed(list(enumerate(found)))}
    return [m for index, m in enumerate(found) if index % every == 0 or first[m.function] == index]


def function_at(tree: ast.Module, line: int) -> str:
    """The dotted name of the innermost function or class around a line."""
    kinds = (ast.FunctionDef, ast.ClassDef)
    around = [n for n in ast.walk(tree) if isinstance(n, kinds) and n.lineno <= line <= (n.end_lineno or 0)]
    return ".".join(node.name for node in sorted(around, key=lambda node: node.lineno)) or "<module>"


def _passive_lines(tree: ast.Module) -> set[int]:
    """Lines of decorators and of fields without a default."""
    nodes: list[ast.AST] = []
    for node in ast.walk(tree):
        nodes += getattr(node, "decorator_list", [])
        nodes += [node] if isinstance(node, ast.AnnAssign) and node.value is None else []
    return {line for node in nodes for line in range(node.lineno, (node.end_lineno or 0) + 1)}


def _annotations(tree: ast.Module) -> list[tuple[tuple[int, int], tuple[int, int]]]:
    nodes = [getattr(node, name, None) for node in ast.walk(tree) for name in ("annotation", "returns")]
    nodes += [node.value for node in ast.walk(tree) if isinstance(node, ast.keyword) and node.arg == "strict"]
    return [((n.lineno, n.col_offset), (n.end_lineno, n.end_col_offset)) for n in nodes if isinstance(n, ast.expr)]


def _compiles(text: str) -> bool:
    try:
        compile(text, "mutant", "exec")
    except SyntaxError:
        return False
    return True


def _difference(old: str, new: str) -> tuple[str, str]:
    """The lines that differ, joined, from both texts."""
    a, b = old.split("\n"), new.split("\n")
    first = next(i for i, (x, y) in enumerate(zip(a, b, strict=False)) if x != y)
    last = next(i for i, (x, y) in enumerate(zip(reversed(a), reversed(b), strict=False)) if x != y)
    before, after = (rows[first : len(rows) - last] for rows in (a, b))
    return " ".join(map(str.strip, before)), " ".join(map(str.strip, after))


def _by_cosmic_ray(text: str, tree: ast.Module) -> Iterator[Change]:
    from cosmic_ray.ast import ast_nodes, get_ast
    from cosmic_ray.mutating import mutate_code
    from cosmic_ray.plugins import get_operator

    nodes, annotations = list(ast_nodes(get_ast(text))), _annotations(tree)
    for name in OPERATORS:
        operator = get_operator(f"core/{name}")()
        places = [start for node in nodes for start, _ in operator.mutation_positions(node)]
        for occurrence, place in enumerate(places):
            if not any(start <= place < end for start, end in annotations):
                yield place[0], mutate_code(text, operator, occurrence)


def _by_us(text: str, tree: ast.Module) -> Iterator[Change]:
    for node in ast.walk(tree):
        for replacement in _replacements(text, node):
            yield node.lineno, _spliced(text, node, replacement)


def _replacements(text: str, node: ast.AST) -> Iterator[str]:
    if isinstance(node, ast.AugAssign | ast.Raise) or (isinstance(node, ast.Expr) and isinstance(node.value, ast.Call)):
        yield "pass"
    elif isinstance(node, ast.BinOp) and isinstance(node.op, ast.FloorDiv | ast.RShift):
        left, right = (ast.get_source_segment(text, side) for side in (node.left, node.right))
        yield f"(-(-({left}) {'//' if isinstance(node.op, ast.FloorDiv) else '>>'} ({right})))"
    elif isinstance(node, ast.Attribute) and node.attr in ENDS:
        yield f"{ast.get_source_segment(text, node.value)}.{ENDS[node.attr]}"
    elif isinstance(node, ast.Name) and node.id in ENDS:
        yield ENDS[node.id]


def _spliced(text: str, node: ast.AST, replacement: str) -> str:
    """The text with another in a node's place; the sources are ASCII there, so that columns are characters."""
    rows = text.split("\n")
    head = "\n".join([*rows[: node.lineno - 1], rows[node.lineno - 1][: node.col_offset]])
    tail = "\n".join([rows[node.end_lineno - 1][node.end_col_offset :], *rows[node.end_lineno :]])
    return head + replacement + tail
