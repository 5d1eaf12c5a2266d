"""Points between vertices, and paths at any angle between centers."""

from __future__ import annotations

import math

import mediant
import numpy as np
import pytest

YARD = ["....", ".##.", "...."]


def test_a_path_leads_from_point_to_point():
    grid = mediant.Grid.from_rows(YARD)
    path = grid.path((0.5, 0.25), (2, 4), k="any")
    assert path.dtype == np.float64 and path.shape == (3, 2)
    assert grid.holds(path, k="any") and (path[0].tolist(), path[-1].tolist()) == ([0.5, 0.25], [2.0, 4.0])
    length = np.hypot(*np.diff(path, axis=0).T).sum()
    assert grid.distance((0.5, 0.25), (2, 4), k="any") == pytest.approx(length, rel=1e-12)
    # Whole floats are vertices, and others are rounded to 1/1024.
    assert grid.path((0.0, 0.0), (0, 3), k="any").dtype == np.int32
    near = grid.path((0.50001, 0.25), (2, 4), k="any")
    assert near[0].tolist() == [0.5, 0.25]
    several = grid.path([(0.5, 0.25), (2.75, 3.5)], np.array([[2.5, 4.0]]), k="any")
    assert several[0].tolist() == [2.75, 3.5]
    assert grid.is_free((0.5, 0.5), k="any") and not grid.is_free((1.5, 1.5), k="any")
    assert not grid.sees((0.5, 0.5), (2.5, 3.5), k="any") and grid.connected((0.5, 0.5), (2.5, 3.5), k="any")


def test_between_centers_paths_bend_at_corners():
    grid = mediant.Grid.from_rows([".@.", "..."])
    how = {"k": "any", "placement": "center"}
    answer = grid.find((0, 0), (0, 2), **how)
    assert answer.path.tolist() == [[0, 0], [0.5, 0.5], [0.5, 1.5], [0, 2]]
    assert answer.distance == answer.any_angle_lower_bound == 1 + math.sqrt(2)
    assert grid.setup(**how) == "anya:any:center-closed"
    assert grid.find((0, 0), (0, 2)).any_angle_lower_bound == 2
    index = grid.prepare("subgoal", **how)
    assert index.distance((0, 0), (0, 2)) == pytest.approx(answer.distance, rel=1e-12)
    paths = index.paths([(0, 0), (1, 0)], [(0, 2), (1, 2)])
    assert paths.points.dtype == np.float64 and paths[1].tolist() == [[1, 0], [1, 2]]
    touched = index.path((0, 0), (0, 2), points="touched")
    assert touched.dtype == np.int32 and {(0, 0), (1, 1), (0, 2)} <= set(map(tuple, touched.tolist()))
    table = index.table([(0, 0), (0.25, 0.25)], [(0, 2), (1, 1)])
    assert table[0, 0] == pytest.approx(answer.distance) and table[1, 1] == pytest.approx(0.75 * math.sqrt(2))
    field = grid.field((0, 0), **how)
    assert field.shape == (2, 3) and field.get((0, 2)) == pytest.approx(answer.distance)
    assert field.distances()[1, 1] == pytest.approx(math.sqrt(2))
    assert field.next()[0, 2].tolist() == [0.5, 1.5]
    assert field.path_from((0, 2)).tolist() == answer.path[::-1].tolist()
    around = grid.field([(0.25, 0), (1, 2)], **how)
    assert around.nearest_source((0, 0)) == (0.25, 0.0) and around.nearest_source((0, 2)) == (1, 2)
    with pytest.raises(mediant.ArgumentError, match="gap"):
        grid.path((0, 0), (0, 2), corners="never", **how)


def test_meters_lead_to_meters():
    world = mediant.World(0.05, (-1, -0.5), shape=(40, 60))
    blocked = np.zeros((40, 60), dtype=bool)
    blocked[5:, 30] = True
    grid = mediant.Grid(blocked, world=world)
    start, goal = (-0.732, 0.123), (1.618, 0.271)
    for placement in ("center", "corner"):
        ends = [world.place_at(*at, placement=placement) for at in (start, goal)]
        path = grid.path(*ends, k="any", placement=placement)
        meters = world.point_of(path, placement=placement)
        # To the half of 1/1024 of a cell, along each axis.
        assert np.abs(meters[0] - start).max() <= 0.05 / 2048 + 1e-12
        assert np.abs(meters[-1] - goal).max() <= 0.05 / 2048 + 1e-12
        assert len(path) == 4 and grid.distance(*ends, k="any", placement=placement) * 0.05 == pytest.approx(
            np.hypot(*np.diff(meters, axis=0).T).sum(), rel=1e-9
        )
    assert world.place_at(-1.1, 0) is None


def test_where_paths_start_at_vertices_points_are_refused():
    grid = mediant.Grid.from_rows(YARD)
    for how in ({}, {"k": 4}, {"placement": "corner", "k": 3}):
        with pytest.raises(mediant.QueryError) as caught:
            grid.path((0.5, 0), (2, 2), **how)
        assert caught.value.code == "between-vertices"
        assert not grid.is_free((0.5, 0), **how)
    with pytest.raises(mediant.QueryError):
        grid.field((0.5, 0))
    with pytest.raises(mediant.ArgumentError):
        grid.edit_cells((0.5, 0), True)
    for wrong in [(math.nan, 0), (0, math.inf)]:
        with pytest.raises(mediant.MediantError):
            grid.path(wrong, (2, 2), k="any")
