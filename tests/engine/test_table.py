"""LandmarkTable: rows are kept, used again, and found by place."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from symboslam.engine.grid import Grid
from symboslam.engine.table import Landmark, LandmarkTable
from symboslam.reasoning.knowledge import Knowledge

GRID = Grid((0.0, 0.0, 100.0, 100.0), 10)


@pytest.fixture
def table() -> LandmarkTable:
    return LandmarkTable(Knowledge.load(), GRID)


def test_what_changed(table: LandmarkTable) -> None:
    one = Landmark("a", 0, 5, 5, 1.0)
    table.put(one)
    assert table.pop_changes() == {"a": (0, None)}
    table.put(Landmark("a", 0, 6, 5, 1.0))
    table.put(Landmark("a", 0, 7, 5, 1.0))
    table.remove("b")
    assert table.pop_changes() == {"a": (0, one)}
    table.remove("a")
    assert table.find("a") is None
    assert len(table) == 0
    table.put(Landmark("b", 0, 1, 1, 1.0))  # in the row that became free
    assert [row for row, _ in table.pop_changes().values()] == [0, 0]
    table.remove("b")
    with pytest.raises(IndexError, match="no landmark in row 0"):
        table[0]


steps = st.lists(
    st.tuples(st.integers(0, 9), st.integers(0, 5), st.floats(0, 100), st.floats(0, 100),
              st.booleans()), max_size=60,
)  # fmt: skip


@given(steps)
def test_found_by_place_and_group(steps: list[tuple[int, int, float, float, bool]]) -> None:
    knowledge = Knowledge.load()
    group = np.arange(len(knowledge.features)) % 3
    table, known = LandmarkTable(knowledge, GRID, group), {}
    for number, feature, x, y, keep in steps:
        if keep:
            known[str(number)] = Landmark(str(number), feature, x, y, 1.0)
            table.put(known[str(number)])
        else:
            known.pop(str(number), None)
            table.remove(str(number))
    assert {table[int(row)].id for row in table.rows()} == set(known)
    for cell in range(100):
        here = {
            m for m in known.values()
            if min(int(m.y // 10), 9) * 10 + min(int(m.x // 10), 9) == cell
        }  # fmt: skip
        assert {table[int(row)] for row in table.within([cell])} == here
        assert table.count(cell) == len(here)
        for number in range(3):
            mine = {m for m in here if m.feature % 3 == number}
            assert {table[int(row)] for row in table.within([cell], number)} == mine
