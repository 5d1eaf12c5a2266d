"""Slow and obvious references: which moves are legal, and how long shortest paths are.

They share no code with the package. Points are (row, column). A map is an array of bool, True is blocked, and
all outside it is blocked.
"""

from __future__ import annotations

import functools
import itertools
import math
from fractions import Fraction

import numpy as np
import scipy.sparse
import scipy.sparse.csgraph

RULES = [("center", "never"), ("center", "one"), ("center", "always"), ("corner", "open")]
RULES += [("corner", "closed")]


def motion(rule):
    """The keywords of a rule of `RULES`."""
    placement, name = rule
    return {"placement": placement, ("corners" if placement == "center" else "gap"): name}


def random_map(rng, rows, columns, density):
    """A random map with at least one free cell."""
    blocked = rng.random((rows, columns)) < density
    blocked[rng.integers(rows), rng.integers(columns)] = False
    return blocked


@functools.cache
def moves(k):
    """N(k): between two adjacent moves of N(k - 1) there is their sum. The axes are N(2)."""
    if k == 2:
        return ((1, 0), (0, 1), (-1, 0), (0, -1))
    known = moves(k - 1)
    pairs = zip(known, known[1:] + known[:1])
    return tuple(itertools.chain.from_iterable((a, (a[0] + b[0], a[1] + b[1])) for a, b in pairs))


def _spans(length, low, high):
    """The times when a point going from 0 to `length` in unit time is inside (low, high); None if never."""
    if length == 0:
        return (Fraction(0), Fraction(1)) if low < 0 < high else None
    first, last = sorted((Fraction(low) / length, Fraction(high) / length))
    return max(first, Fraction(0)), min(last, Fraction(1))


@functools.cache
def footprint(placement, dr, dc):
    """The cells and vertices that decide whether a segment from (0, 0) to (dr, dc) is legal.

    Returns the cells whose interior it enters, the pairs of cells beside the corners that it passes through
    (at centers) or beside the edges that it runs along (at corners), and the vertices that it passes through.
    """
    half = Fraction(1, 2) if placement == "center" else Fraction(0)
    entered, beside, passed = [], [], []
    for row in range(min(dr, 0) - 1, max(dr, 0) + 2):
        for column in range(min(dc, 0) - 1, max(dc, 0) + 2):
            spans = [_spans(d, x - half, x + 1 - half) for d, x in ((dr, row), (dc, column))]
            if all(spans) and max(spans[0][0], spans[1][0]) < min(spans[0][1], spans[1][1]):
                entered.append((row, column))
            # The corner at the top left of this cell.
            at = (row - half, column - half)
            is_on = at[0] * dc == at[1] * dr and (dr or dc)
            time = at[0] / dr if dr else at[1] / Fraction(dc) if dc else Fraction(0)
            if not (is_on and 0 < time < 1):
                continue
            passed.append((row, column))
            if placement == "center":
                same = (dr > 0) == (dc > 0)
                falling = ((row - 1, column), (row, column - 1))
                beside.append(falling if same else ((row - 1, column - 1), (row, column)))
    if placement == "corner" and (dr == 0) != (dc == 0):
        for step in range(abs(dr + dc)):
            along = step if dr + dc > 0 else -1 - step
            beside.append(((along, -1), (along, 0)) if dr else ((-1, along), (0, along)))
    return tuple(entered), tuple(beside), tuple(passed)


class Slow:
    """A map with a rule of motion."""

    def __init__(self, blocked, rule):
        self.blocked, (self.placement, self.name) = np.asarray(blocked, dtype=bool), rule
        self.at_corners = self.placement == "corner"
        rows, columns = self.blocked.shape
        self.shape = (rows + self.at_corners, columns + self.at_corners)

    def is_blocked(self, row, column):
        rows, columns = self.blocked.shape
        return not (0 <= row < rows and 0 <= column < columns) or bool(self.blocked[row, column])

    def is_free(self, at):
        row, column = at
        if not self.at_corners:
            return not self.is_blocked(row, column)
        return not all(self.is_blocked(row - i, column - j) for i in (0, 1) for j in (0, 1))

    def is_gap(self, at):
        row, column = at
        cells = [self.is_blocked(row - i, column - j) for i, j in ((0, 0), (1, 1), (0, 1), (1, 0))]
        return cells in ([True, True, False, False], [False, False, True, True])

    def sees(self, start, goal):
        """Whether the straight segment is legal."""
        if not (self.is_free(start) and self.is_free(goal)):
            return False
        (row, column), (dr, dc) = start, (goal[0] - start[0], goal[1] - start[1])
        entered, beside, passed = footprint(self.placement, dr, dc)
        if any(self.is_blocked(row + i, column + j) for i, j in entered):
            return False
        if self.name == "closed" and any(self.is_gap((row + i, column + j)) for i, j in passed):
            return False
        counts = [sum(not self.is_blocked(row + i, column + j) for i, j in pair) for pair in beside]
        least = {"never": 2, "one": 1, "always": 0, "open": 1, "closed": 1}[self.name]
        return all(count >= least for count in counts)

    def vertices(self):
        rows, columns = self.shape
        return [(row, column) for row in range(rows) for column in range(columns)]

    def quadrants(self, at):
        """The states of a vertex: one for each free cell around a closed gap, else one for all."""
        if self.name != "closed" or not self.is_gap(at):
            return [None]
        around = [(0, 0), (-1, 0), (0, -1), (-1, -1)]
        return [(i, j) for i, j in around if not self.is_blocked(at[0] + i, at[1] + j)]

    def cost(self, start, goal):
        """The cost of a move: its length."""
        return math.dist(start, goal)

    def graph(self, k):
        """The graph of legal moves, as a matrix of lengths; its nodes are vertices in a quadrant."""
        vertices = [at for at in self.vertices() if self.is_free(at)]
        pairs = ((at, q) for at in vertices for q in self.quadrants(at))
        states = {pair: i for i, pair in enumerate(pairs)}
        data, ends = [], []
        for start in vertices:
            if k == "any":
                goals = vertices
            else:
                goals = [(start[0] + dr, start[1] + dc) for dr, dc in moves(k)]
            for goal in goals:
                if start == goal or not self.sees(start, goal):
                    continue
                for q, p in itertools.product(self.quadrants(start), self.quadrants(goal)):
                    if _within(start, q, goal) and _within(goal, p, start):
                        data.append(self.cost(start, goal))
                        ends.append((states[start, q], states[goal, p]))
        ends = np.array(ends, dtype=int).reshape(-1, 2)
        size = len(states)
        return states, scipy.sparse.csr_matrix((data, (ends[:, 0], ends[:, 1])), shape=(size, size))

    def distances(self, k, sources):
        """The distances of all vertices from each source."""
        # A path ends at a closed gap in the quadrant of the vertex's own cell.
        states, graph = self.graph(k)
        own = {at: states.get((at, q)) for at, q in states if q in (None, (0, 0))}
        result = np.full((len(sources), *self.shape), np.inf)
        for i, source in enumerate(sources):
            if own.get(source) is not None:
                found = scipy.sparse.csgraph.dijkstra(graph, indices=own[source])
                for at, state in own.items():
                    result[(i, *at)] = found[state]
            if self.is_free(source):
                result[(i, *source)] = 0.0
        return result

    def is_path(self, path, k="any"):
        """The reason why an array is no path over N(k); None if it is one."""
        path = [tuple(map(int, at)) for at in path]
        for a, b in zip(path, path[1:]):
            d = (b[0] - a[0], b[1] - a[1])
            times = math.gcd(*d)
            if times == 0 or (k != "any" and (d[0] // times, d[1] // times) not in moves(k)):
                return f"no move from {a} to {b}"
            if not self.sees(a, b):
                return f"{a} does not see {b}"
        if not all(map(self.is_free, path)):
            return "a waypoint is blocked"
        if self.name == "closed":
            for i, at in enumerate(path):
                is_end = i in (0, len(path) - 1)
                near = path[max(i - 1, 0) : i] + path[i + 1 : i + 2]
                quadrants = [q for q in self.quadrants(at) if not is_end or q in (None, (0, 0))]
                if near and not any(all(_within(at, q, other) for other in near) for q in quadrants):
                    return f"a turn at the closed gap {at}"
        return None


class SlowCosts(Slow):
    """A map with a rule of motion, whose cells have costs, and a height and a width."""

    def __init__(self, blocked, rule, costs, cell_size=(1.0, 1.0)):
        super().__init__(blocked, rule)
        self.costs, self.cell_size = np.asarray(costs, dtype=float), cell_size

    def cost(self, start, goal):
        """The cost of a move: for each cell that it crosses, its length there times the cell's cost."""
        (row, column), (dr, dc) = start, (goal[0] - start[0], goal[1] - start[1])
        half = Fraction(1, 2) if self.placement == "center" else Fraction(0)
        entered, beside, _ = footprint(self.placement, dr, dc)
        total = 0.0
        for i, j in entered:
            spans = [_spans(d, x - half, x + 1 - half) for d, x in ((dr, i), (dc, j))]
            share = min(span[1] for span in spans) - max(span[0] for span in spans)
            total += float(share) * self.costs[row + i, column + j]
        if self.at_corners and (dr == 0) != (dc == 0):
            for pair in beside:
                free = [(row + i, column + j) for i, j in pair if not self.is_blocked(row + i, column + j)]
                total += min(self.costs[cell] for cell in free) / len(beside)
        return total * math.hypot(dr * self.cell_size[0], dc * self.cell_size[1])

    def path_cost(self, path, k):
        """The cost of a path over N(k), move by move."""
        total = 0.0
        for a, b in zip(path, path[1:]):
            d = (int(b[0] - a[0]), int(b[1] - a[1]))
            steps = math.gcd(*d)
            at = tuple(map(int, a))
            for _ in range(steps):
                after = (at[0] + d[0] // steps, at[1] + d[1] // steps)
                total += self.cost(at, after)
                at = after
        return total


def _within(at, quadrant, other):
    """Whether a path from a vertex may lead to another one through this quadrant."""
    if quadrant is None:
        return True
    return all((b - a) * (2 * q + 1) >= 0 for a, b, q in zip(at, other, quadrant))


def length(path):
    """The length of a path's array."""
    return float(np.hypot(*np.diff(np.asarray(path, dtype=float), axis=0).T).sum())
