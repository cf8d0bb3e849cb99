"""``python -m tools.sbom WHEEL``: what a wheel asks for, as locked and tested, in CycloneDX 1.6 beside the wheel.

The wheel contains none of it: ``scope`` is "required" for the base install and "optional" for what an extra brings.
The file depends on the wheel, the lock files and docs/licences.md alone: the same sources give the same bytes.
"""

from __future__ import annotations

import hashlib
import json
import re
import sys
import uuid
from pathlib import Path

from tools.locks import ROOT, Pin, asked_for, closure, locked, needs, project

Json = dict[str, object]
SPECIFICATION = "1.6"


def purl(pin: Pin) -> str:
    """The package URL, which is its reference in the file too."""
    return f"pkg:pypi/{pin.name}@{pin.version}"


def licences() -> dict[str, str]:
    """Name -> SPDX expression, from docs/licences.md."""
    text = (ROOT / "docs" / "licences.md").read_text("utf-8")
    return dict(re.findall(r"^\| ([\w.-]+) \| ([^|]+) \| [^|]+ \|$", text, re.MULTILINE))


def bill(wheel: Path) -> Json:
    """The bill of materials of a wheel."""
    packages, groups, table = locked(), asked_for(), project()
    users = {group: closure(names, packages) for group, names in groups.items()}
    wanted = sorted(set().union(*users.values()))
    digest = hashlib.sha256(wheel.read_bytes()).hexdigest()
    name, version = str(table["name"]), str(table["version"])
    own = f"pkg:pypi/{name.replace('_', '-')}@{version}"
    terms = licences()

    def references(names: list[str]) -> list[str]:
        return sorted({purl(pin) for other in names if other in wanted for pin in packages[other]})

    def component(pin: Pin) -> Json:
        extras = [group for group, found in users.items() if pin.name in found]
        properties = [{"name": "fomas_verify:for", "value": extra} for extra in extras]
        if pin.marker:
            properties.append({"name": "fomas_verify:marker", "value": pin.marker})
        return {
            "type": "library",
            "bom-ref": purl(pin),
            "name": pin.name,
            "version": pin.version,
            "scope": "required" if "base" in extras else "optional",
            "licenses": [{"expression": terms[pin.name]}],
            "purl": purl(pin),
            "properties": properties,
        }

    return {
        "$schema": f"http://cyclonedx.org/schema/bom-{SPECIFICATION}.schema.json",
        "bomFormat": "CycloneDX",
        "specVersion": SPECIFICATION,
        "serialNumber": uuid.uuid5(uuid.NAMESPACE_URL, f"{own}#{digest}").urn,
        "version": 1,
        "metadata": {
            "component": {
                "type": "library",
                "bom-ref": own,
                "name": name,
                "version": version,
                "hashes": [{"alg": "SHA-256", "content": digest}],
                "licenses": [{"expression": str(table["license"])}],
                "purl": own,
            }
        },
        "components": [component(pin) for other in wanted for pin in packages[other]],
        "dependencies": [
            {"ref": own, "dependsOn": references([other for names in groups.values() for other in names])},
            *(
                {"ref": purl(pin), "dependsOn": references(needs(other, packages))}
                for other in wanted
                for pin in packages[other]
            ),
        ],
    }


def main(wheel: Path) -> None:
    """Write the bill beside the wheel, named as it is up to the version."""
    path = wheel.with_name("-".join(wheel.name.split("-")[:2]) + ".cdx.json")
    path.write_text(json.dumps(bill(wheel), indent=2) + "\n", "utf-8")
    sys.stdout.write(f"{path}\n")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
