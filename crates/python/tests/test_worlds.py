"""Worlds made by hand, scenarios, scattered edits, discs among obstacles that change."""

from __future__ import annotations

import math
import pickle

import mediant
import numpy as np
import pytest
import slow


def test_worlds_by_hand(rng):
    cells = slow.random_map(rng, 20, 40, 0.3)
    world = mediant.World(0.05, (-1, -0.5), shape=(20, 40))
    assert (world.resolution, world.origin, world.shape) == (0.05, (-1, -0.5, 0), (20, 40))
    grid = mediant.Grid(cells, world=world)
    assert grid.world == world == mediant.Grid(cells, resolution=0.05, origin=(-1, -0.5)).world
    assert hash(grid.world) == hash(world) and pickle.loads(pickle.dumps(world)) == world
    assert pickle.loads(pickle.dumps(grid)).world == world
    assert mediant.Grid(cells).with_world(world) == grid != mediant.Grid(cells)
    assert grid.with_world(None) == mediant.Grid(cells)
    for kept in (grid.edit((0, 0), [[True]]), grid.edit_cells((0, 0), True), grid.for_disc(meters=0.05)):
        assert kept.world == world
    assert world.cells(1) == pytest.approx(20) and world != mediant.World(0.05, shape=(20, 40))
    assert mediant.World(1, (0.0, 0.0, 0.0), shape=[2, 3]) == mediant.World(1, (-0.0, 0.0), shape=(2, 3))
    assert hash(mediant.World(1, (0.0, 0.0), shape=[2, 3])) == hash(
        mediant.World(1, (-0.0, 0.0), shape=(2, 3))
    )


def test_mistakes_of_worlds():
    for wrong, name in [((0,), "resolution"), ((1, (1,)), "origin"), ((1, (math.inf, 0)), "origin")]:
        with pytest.raises(mediant.ArgumentError, match=name):
            mediant.World(*wrong, shape=(2, 3))
    for shape in [(0, 3), (2, 99999)]:
        with pytest.raises(mediant.MapError, match="shape"):
            mediant.World(1, shape=shape)
    for shape in [(2,), (1, 2, 3)]:
        with pytest.raises(mediant.ArgumentError, match="shape"):
            mediant.World(1, shape=shape)
    world = mediant.World(1, shape=(2, 3))
    with pytest.raises(mediant.ArgumentError, match=r"world: expected that of a map of 3 . 2 cells"):
        mediant.Grid(np.zeros((3, 2), dtype=bool), world=world)
    with pytest.raises(mediant.ArgumentError, match="world: it has a resolution"):
        mediant.Grid(np.zeros((2, 3), dtype=bool), world=world, resolution=1)
    with pytest.raises(TypeError, match="world: expected a World"):
        mediant.Grid(np.zeros((2, 3), dtype=bool)).with_world((1, 2))


SCENARIO = b"version 1\n3\tmaps/a b.map\t4\t3\t0\t1\t3\t2\t3.5\n0\tmaps/a b.map\t4\t3\t1\t0\t1\t0\t0\n"
SCENARIO += b"9\tb.map\t7\t3\t6\t2\t0\t0\t0\n"


def test_scenarios(tmp_path):
    file = tmp_path / "a.scen"
    file.write_bytes(SCENARIO)
    scenario = mediant.Scenario.open(file)
    assert len(scenario) == 3
    assert scenario.starts.tolist() == [[1, 0], [0, 1], [2, 6]]
    assert scenario.goals.tolist() == [[2, 3], [0, 1], [0, 0]]
    # A path from a place to itself has length 0; between two places 0 says that it is not known.
    assert np.array_equal(scenario.lengths, [3.5, 0, np.nan], equal_nan=True)
    assert scenario.buckets.tolist() == [3, 0, 9]
    assert scenario.maps == ["maps/a b.map"] * 2 + ["b.map"]
    assert scenario.shapes.tolist() == [[3, 4], [3, 4], [3, 7]]
    types = [array.dtype for array in (scenario.starts, scenario.lengths, scenario.buckets, scenario.shapes)]
    assert types == [np.int32, np.float64, np.uint32, np.uint32]
    with pytest.raises(mediant.MismatchError, match=r"instance 2 .* 3 . 7 cells, found .* 3 . 4 cells"):
        scenario.check(mediant.Grid(np.zeros((3, 4), dtype=bool)))
    empty = mediant.Scenario.from_bytes(b"version 1\n")
    assert (len(empty), empty.starts.shape, empty.shapes.shape) == (0, (0, 2), (0, 2))


def test_mistakes_of_scenarios(tmp_path):
    with pytest.raises(FileNotFoundError):
        mediant.Scenario.open(tmp_path / "none.scen")
    file = tmp_path / "a.scen"
    file.write_bytes(SCENARIO + b"0 a 1\n")
    with pytest.raises(mediant.FileError, match="line 5") as caught:
        mediant.Scenario.open(file)
    assert caught.value.code == "scenario-format"
    with pytest.raises(mediant.FileError, match="data: line 1") as caught:
        mediant.Scenario.from_bytes(b"")
    assert caught.value.code == "scenario-format"


def test_edits_of_scattered_cells(rng):
    cells = slow.random_map(rng, 17, 70, 0.4)
    grid = mediant.Grid(cells)
    for count in (0, 1, 2, 300):
        at = np.c_[rng.integers(17, size=count), rng.integers(70, size=count)]
        values, wanted = rng.random(count) < 0.5, cells.copy()
        for point, value in zip(at, values):
            wanted[tuple(point)] = value
        assert np.array_equal(grid.edit_cells(at, values).to_numpy(), wanted)
        wanted[tuple(at.T)] = True
        assert (
            grid.edit_cells(at, True)
            == mediant.Grid(wanted)
            == grid.edit_cells(at, values).edit_cells(at, [True])
        )
    with pytest.raises(mediant.MapError, match=r"cells: cell \(17, 0\) is outside the map of 17 . 70 cells"):
        grid.edit_cells([(0, 0), (17, 0)], True)
    with pytest.raises(mediant.ArgumentError, match="blocked: expected one value for each of 3 cells"):
        grid.edit_cells([(0, 0)] * 3, [True, False])
    with pytest.raises(TypeError, match="blocked"):
        grid.edit_cells((0, 0), 1)


def test_discs_among_obstacles_that_change(rng):
    grid = mediant.Grid(slow.random_map(rng, 40, 50, 0.03)).with_world(mediant.World(0.5, shape=(40, 50)))
    for how in ({}, {"k": "any"}, {"corners": "always", "k": 4}):
        disc = grid.disc(meters=0.8, **how)
        assert disc.radius == 1.6
        for _ in range(12):
            at, cells = rng.integers((37, 47)), rng.random((3, 3)) < 0.4
            disc = disc.edit(at, cells)
            assert disc.grid == disc.obstacles.for_disc(1.6, **how)
            assert disc.obstacles.world == grid.world
    with pytest.raises(mediant.MapError, match="not wholly on the map"):
        disc.edit((39, 49), [[True, True]])
    with pytest.raises(mediant.ArgumentError, match="radius"):
        grid.disc(-1)
