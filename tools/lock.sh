#!/usr/bin/env bash
# Writes requirements/*.txt anew: names, versions and hashes of every file of each release, for Python 3.11 to 3.13 on any
# platform. dev.txt comes first and holds the others to its versions, so that one environment serves all. Needs `uv`.
set -euo pipefail
cd "$(dirname "$0")/.."
command -v uv >/dev/null || { echo "tools/lock.sh: uv is missing (pip install uv)" >&2; exit 2; }

lock() {
    local out=$1
    shift
    uv pip compile pyproject.toml --group build "$@" --output-file "requirements/$out" --quiet --upgrade \
        --universal --python-version 3.11 --generate-hashes --no-header --no-config \
        --no-emit-index-url --no-emit-find-links
}

lock dev.txt --extra dev
lock base.txt --extra report --constraint requirements/dev.txt
lock bench.txt --extra dev --extra region --constraint requirements/dev.txt

for group in peers guided; do
    uv pip compile --group "$group" --no-deps --output-file "requirements/$group.txt" --quiet --upgrade \
        --universal --python-version 3.11 --generate-hashes --no-header --no-config \
        --no-emit-index-url --no-emit-find-links
done
