"""The tables of README.md, from index.toml; a theorem's name leads to the line of its statement.

python tables.py           write them
python tables.py --check   exit status 1 if they are not what stands there
"""

import re
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

PROOFS = Path(__file__).resolve().parent
INLINE = {"certificate", "example"}
REGION = re.compile(r"(<!-- table: (\w+) -->\n).*?(<!-- end -->)", re.DOTALL)


def places(theorems: list[dict[str, Any]]) -> dict[str, str]:
    """Where each theorem is stated and each thing of the model defined: file and line."""
    found = {}
    for path in sorted((PROOFS / "Model").glob("*.v")):
        for number, line in enumerate(path.read_text("utf-8").splitlines(), 1):
            if match := re.match(r"Definition (\w+)", line):
                found[match[1]] = f"Model/{path.name}#L{number}"
    for path in sorted((PROOFS / "Statements").glob("*.v")):
        for number, line in enumerate(path.read_text("utf-8").splitlines(), 1):
            if match := re.match(r"Definition (\w+)_statement\b", line):
                found[match[1]] = f"Statements/{path.name}#L{number}"
    for entry in theorems:
        if entry["status"] in INLINE:
            lines = (PROOFS / entry["file"]).read_text("utf-8").splitlines()
            number = next(n for n, line in enumerate(lines, 1) if re.match(rf"Theorem {entry['name']}\b", line))
            found[entry["name"]] = f"{entry['file']}#L{number}"
    return found


def row(*cells: str) -> str:
    return f"| {' | '.join(cell.replace('|', '&#124;') for cell in cells)} |\n"


def head(*titles: str) -> str:
    return row(*titles) + "|---" * len(titles) + "|\n"


def tables(index: dict[str, Any]) -> dict[str, str]:
    """The text of each table by its name in README.md."""
    where = places(index["theorem"])

    def links(names: list[str]) -> str:
        return ", ".join(f"[`{name}`]({where[name]})" for name in names)

    def sentences() -> Iterator[str]:
        yield head("label", "sentence", "status", "Coq", "remark")
        for entry in index["sentence"]:
            names = [*entry.get("model", []), *entry["coq"]]
            yield row(entry["label"], entry["text"], entry["status"], links(names), entry["note"])

    def beyond() -> Iterator[str]:
        named = {name for entry in index["sentence"] for name in entry["coq"]}
        yield head("statement", "Coq", "theory")
        for entry in index["theorem"]:
            if entry["name"] not in named:
                yield row(entry["says"], links([entry["name"]]), f"section {entry['theory']}")

    def unproved() -> Iterator[str]:
        yield head("statement", "remark")
        for entry in index["open"]:
            yield row(f"{entry['text']} (theory, section {entry['theory']})", entry["why"])

    def proofs() -> Iterator[str]:
        yield head("file", "theorems")
        for file in dict.fromkeys(entry["file"] for entry in index["theorem"]):
            names = [f"`{entry['name']}`" for entry in index["theorem"] if entry["file"] == file]
            yield row(f"[{file}]({file})", ", ".join(names))

    parts = {"sentences": sentences(), "beyond": beyond(), "unproved": unproved(), "proofs": proofs()}
    return {name: "".join(lines) for name, lines in parts.items()}


def filled(text: str, index: dict[str, Any]) -> str:
    """README.md with its tables written anew."""
    text_of = tables(index)
    return REGION.sub(lambda match: match[1] + text_of[match[2]] + match[3], text)


def main() -> int:
    readme = PROOFS / "README.md"
    old = readme.read_text("utf-8")
    new = filled(old, tomllib.loads((PROOFS / "index.toml").read_text("utf-8")))
    if "--check" not in sys.argv[1:]:
        readme.write_text(new, "utf-8")
        return 0
    if new != old:
        print("README.md: its tables are not those of index.toml; write them with: python tables.py")
    return int(new != old)


if __name__ == "__main__":
    sys.exit(main())
