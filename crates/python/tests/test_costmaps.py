"""Robots' costmaps: inflation against the formula of nav2 for each cell; bytes as costs; what is refused."""

from __future__ import annotations

import itertools
import math
import pickle

import mediant
import numpy as np
import pytest
import slow


def inflated_bytes(blocked, resolution, inscribed, radius, factor):
    """The byte of each cell, and where rounding may make it another one."""
    at = np.argwhere(blocked)
    values = np.zeros(blocked.shape)
    reach = math.ceil(radius / resolution)
    for cell in itertools.product(*map(range, blocked.shape)):
        squared = int(((at - cell) ** 2).sum(axis=1).min()) if len(at) else 10**9
        distance = math.sqrt(squared) * resolution
        if squared == 0:
            values[cell] = 254
        elif squared > reach**2:
            values[cell] = 0
        elif distance <= inscribed:
            values[cell] = 253
        else:
            values[cell] = 252 * math.exp(-factor * (distance - inscribed))
    return np.floor(values), np.abs(values - np.round(values)) < 1e-6


def test_inflation_is_that_of_the_formula(rng):
    """In cells, and in meters where the grid has a place in the world, which it keeps."""
    unlike = 0
    for step in range(20):
        blocked = slow.random_map(rng, 9, 13, rng.choice([0.02, 0.1, 0.2]))
        resolution = (1.0, 0.05, 2.5)[step % 3]
        world = mediant.World(resolution, (1, 2, 0.5), shape=(9, 13)) if step % 3 else None
        inscribed = rng.choice([0.0, 0.7, 1.3]) * resolution
        radius = inscribed + rng.choice([0.0, 1.6, 4.3]) * resolution
        factor, weight = rng.uniform(0.1, 2.0) / resolution, rng.choice([0.0, 2.0, 7.5])
        grid = mediant.Grid(blocked, world=world)
        inflated = grid.inflated(
            inflation_radius=radius,
            inscribed_radius=inscribed,
            cost_scaling_factor=factor,
            weight=weight,
        )
        note = (blocked.tolist(), resolution, inscribed, radius, factor, weight)
        wanted, is_near = inflated_bytes(blocked, resolution, inscribed, radius, factor)
        assert inflated.world == world and inflated.shape == grid.shape, note
        assert np.array_equal(inflated.to_numpy(), wanted >= 253), note
        costs = np.where(wanted >= 253, np.nan, 1 + weight * wanted / 252)
        is_right = np.isclose(inflated.costs, costs, rtol=1e-8, equal_nan=True)
        assert (is_right | is_near).all(), note
        unlike += len(np.unique(wanted)) > 4
        # The same by way of the bytes.
        if not is_near[(wanted > 0) & (wanted < 253)].any():
            again = mediant.Grid.from_costmap(wanted.astype("u1"), weight=weight, world=world)
            assert again == inflated, note
        assert pickle.loads(pickle.dumps(inflated)) == inflated
    assert unlike > 5


def test_defaults_of_inflation():
    """No robot's radius, a weight of 2, and costs that fall to those of byte 1."""
    blocked = np.zeros((1, 9), dtype=bool)
    blocked[0, 0] = True
    grid = mediant.Grid(blocked)
    byte = (grid.inflated(inflation_radius=5.5).costs[0] - 1) * 252 / 2
    falling = [252 * math.exp(-math.log(252) * d / 5.5) for d in range(1, 7)]
    assert np.allclose(byte[1:7], np.floor(falling), atol=1e-5) and (np.abs(byte[7:]) < 1e-5).all()
    assert grid.inflated(inflation_radius=0) == mediant.Grid(blocked, costs=np.ones((1, 9)))
    path = mediant.Grid.from_rows(["#......", ".......", "......."]).inflated(inflation_radius=3)
    assert path.find((1, 0), (0, 1), k=3).cost > math.sqrt(2)


def test_bytes_are_costs(rng):
    """Of arrays of any kind; a path costs its length and the weight times the bytes on it."""
    for dtype in ("u1", "<i2", ">i4", "<u8", "<i8"):
        numbers = rng.integers(0, 256, size=(7, 11)).astype(dtype)
        numbers[0, :4] = [252, 253, 254, 255]
        weight = rng.choice([0.0, 1.0, 4.032])
        blocked = numbers > 252
        costs = 1 + weight * numbers.astype(float) / 252
        for layout in (numbers, np.asfortranarray(numbers), numbers[::-1].copy()[::-1], numbers.tolist()):
            grid = mediant.Grid.from_costmap(layout, weight=weight)
            assert np.array_equal(grid.to_numpy(), blocked)
            assert np.allclose(grid.costs, np.where(blocked, np.nan, costs), rtol=1e-8, equal_nan=True)
        crossed = mediant.Grid.from_costmap(numbers, weight=weight, unknown=100)
        costs[numbers == 255] = 1 + weight * 100 / 252
        blocked &= numbers != 255
        assert np.allclose(crossed.costs, np.where(blocked, np.nan, costs), rtol=1e-8, equal_nan=True)
        oracle = slow.SlowCosts(blocked, slow.RULES[0], costs)
        how, start = slow.motion(slow.RULES[0]), tuple(np.argwhere(~blocked)[0])
        found = crossed.field(start, k=3, **how).distances()
        assert np.allclose(found, oracle.distances(3, [start])[0], rtol=1e-8)
    grid = mediant.Grid.from_costmap(np.zeros((3, 4), "u1"))
    assert grid.world is None and grid == mediant.Grid.from_costs(np.ones((3, 4)))
    world = mediant.World(0.05, shape=(3, 4))
    assert mediant.Grid.from_costmap(np.zeros((3, 4), "u1"), world=world).world == world
    assert mediant.Grid.from_costmap([[254, 253]]).to_numpy().all()


@pytest.mark.parametrize(
    ("make", "error", "words"),
    [
        (lambda grid: grid.inflated(), TypeError, "inflation_radius"),
        (lambda grid: grid.inflated(inflation_radius=-1), mediant.ArgumentError, "inflation_radius.*-1"),
        (lambda grid: grid.inflated(inflation_radius=np.inf), mediant.ArgumentError, "inflation_radius"),
        (
            lambda grid: grid.inflated(inflation_radius=1, inscribed_radius=2),
            mediant.ArgumentError,
            "inflation_radius.*inscribed",
        ),
        (
            lambda grid: grid.inflated(inflation_radius=1, cost_scaling_factor=np.nan),
            mediant.ArgumentError,
            "cost_scaling_factor",
        ),
        (lambda grid: grid.inflated(inflation_radius=1, weight=-1), mediant.ArgumentError, "weight"),
        (lambda grid: grid.inflated(inflation_radius=1, weight=1e9), mediant.ArgumentError, "weight"),
        (
            lambda grid: grid.inflated(inflation_radius=1).inflated(inflation_radius=1),
            mediant.OptionError,
            "costs.*inflation",
        ),
        (lambda grid: grid.from_costmap([[0.5]]), TypeError, "costmap.*float64"),
        (lambda grid: grid.from_costmap([[True]]), TypeError, "costmap.*bool"),
        (lambda grid: grid.from_costmap([[-1, 100]]), mediant.ArgumentError, "costmap.*-1.*from_occupancy"),
        (lambda grid: grid.from_costmap([[256]]), mediant.ArgumentError, "costmap.*256"),
        (lambda grid: grid.from_costmap([0, 1]), mediant.ArgumentError, "costmap.*rows and columns"),
        (lambda grid: grid.from_costmap(np.zeros((0, 3), "u1")), mediant.MapError, "costmap"),
        (lambda grid: grid.from_costmap([[0]], unknown=253), mediant.ArgumentError, "unknown.*253"),
        (lambda grid: grid.from_costmap([[0]], unknown="free"), TypeError, "unknown"),
        (
            lambda grid: grid.from_costmap([[0]], world=mediant.World(1, shape=(2, 2))),
            mediant.ArgumentError,
            "world",
        ),
    ],
)
def test_mistakes_say_what_to_do(make, error, words):
    with pytest.raises(error, match=words):
        make(mediant.Grid.from_rows(["#..", "..."]))
