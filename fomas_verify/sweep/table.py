"""A part of a sweep as a Parquet file: its columns, its bytes, and whether a file is a certain part, whole."""

from __future__ import annotations

from pathlib import Path
from threading import Lock
from typing import Any

from fomas_verify.exact.errors import out_of_memory, source_name
from fomas_verify.sweep.errors import SweepError
from fomas_verify.sweep.plan import Plan
from fomas_verify.sweep.rows import VALUES, decide_rows

MARK = b"fomas_sweep"
_ONE_AT_A_TIME = Lock()
"""Arb's working precision belongs to the process: a worker with several threads computes in one of them."""


def need_pyarrow() -> None:
    """Raise `SweepError` where pyarrow is missing."""
    try:
        import pyarrow  # noqa: F401
    except ImportError as error:
        raise SweepError(
            f"a sweep needs {error.name}, which the extra `sweep` brings: pip install 'fomas_verify[sweep]'"
        ) from None


def schema(plan: Plan) -> Any:
    """The columns: row, the swept parameters, status, verdicts, values, message."""
    import pyarrow as pa

    kinds = {"family": pa.string(), "agents": pa.int32(), "shape": pa.string()}
    fields = [pa.field("row", pa.int64(), nullable=False)]
    fields += [pa.field(name, kinds[name]) for name in plan.grid.graph_axes]
    for axis in plan.grid.axes:
        fields += [pa.field(axis.name, pa.float64()), pa.field(f"{axis.name}_exact", pa.string())]
    fields += [pa.field("status", pa.int8(), nullable=False)]
    fields += [pa.field(f"verdict_{claim}", pa.string()) for claim in plan.claims]
    fields += [pa.field(f"{name}_{end}", pa.float64()) for name in VALUES for end in ("lower", "upper")]
    return pa.schema([*fields, pa.field("message", pa.string())])


def compute_part(plan: Plan, part: int) -> bytes:
    """Decide the designs of a part; the bytes of its file, the same wherever it is computed with the same pyarrow."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    with _ONE_AT_A_TIME:
        rows = list(decide_rows(plan, plan.rows_of(part)))
    columns = schema(plan).with_metadata({MARK: _mark(plan, part)})
    sink = pa.BufferOutputStream()
    pq.write_table(pa.Table.from_pylist(rows, schema=columns), sink, compression="zstd", write_page_checksum=True)
    return bytes(sink.getvalue())


def columns_of(path: Path, names: list[str]) -> Any:
    """Some columns of a part, their checksums verified; raises `SweepError` where it is damaged.

    No thread is started, which pyarrow waits for in vain where a limit leaves no memory.
    """
    import pyarrow as pa
    import pyarrow.parquet as pq

    try:
        with pq.ParquetFile(path, page_checksum_verification=True) as file:
            return file.read(columns=names, use_threads=False)
    except (OSError, pa.ArrowException) as error:
        if out_of_memory(error) or "launch worker thread" in str(error):  # so says pyarrow where it gets no memory
            raise
        raise SweepError(
            f"{source_name(path)}: expected a whole part, got a damaged one: without it the same call computes it again"
        ) from None


def is_whole(plan: Plan, part: int, path: Path) -> bool:
    """Whether a file is this part of this plan, with all its rows."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    try:
        found = pq.read_metadata(path)
    except (OSError, pa.ArrowException):
        return False
    mark = (found.metadata or {}).get(MARK)
    return bool(found.num_rows == len(plan.rows_of(part)) and mark == _mark(plan, part))


def _mark(plan: Plan, part: int) -> bytes:
    return f"{plan.digest}:{part}".encode()
