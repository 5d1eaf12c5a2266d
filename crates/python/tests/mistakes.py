"""Mistaken arguments: strategies of hypothesis for numbers, arrays and evil objects."""

from __future__ import annotations

import decimal
import fractions
import os
import tempfile

import numpy as np
from hypothesis import strategies as st


class EvilError(Exception):
    """The error that evil objects raise."""


NUMBERS = st.one_of(
    st.sampled_from([-1, 0, 1, 2, 3, 7, 2**31 - 1, 2**31, -(2**31) - 1, 2**63, 2**64, 10**400, -(10**400)]),
    st.sampled_from(
        [0.5, -0.5, -0.0, 1e300, 1e-300, float("nan"), float("inf"), float("-inf"), 1j, True, False]
    ),
    st.sampled_from(
        [np.int8(-1), np.uint64(2**64 - 1), np.int64(3), np.float16(1), np.longdouble(2), np.bool_(True)]
    ),
    st.sampled_from(
        [np.float64("nan"), np.datetime64("2020-01-01"), np.timedelta64(3, "s"), np.complex64(1)]
    ),
    st.builds(fractions.Fraction, st.integers(-9, 9), st.integers(1, 5)),
    st.builds(decimal.Decimal, st.integers(-9, 9)),
    st.integers(-40, 40),
    st.floats(),
)
OTHERS = st.one_of(
    st.none(),
    st.sampled_from(
        ["", "x", "any", "3", "never", "corner", "astar", "jps-plus", "\ud800", "\0", "ä" * 300, b"", b"x"]
    ),
    st.sampled_from(
        [bytearray(b"abc"), memoryview(b"abcd"), (), [], {}, set(), frozenset({1}), {1: 2}, range(3), ...]
    ),
    st.sampled_from(
        [int, str, object(), NotImplemented, np.ma.masked, np, len, [[]], [[1], [1, 2]], [None], ["a", "b"]]
    ),
    st.sampled_from(
        [(1,), (1, 2, 3), ((1, 2),), (1.0, 2.0), (None, 1), ("1", "2"), [(1, 3), (0, 2**40)], (2**70, 1)]
    ),
    st.builds(lambda n: (i for i in range(n)), st.integers(0, 3)),
    st.lists(st.tuples(st.integers(-2, 9), st.integers(-2, 9)), max_size=3),
    st.tuples(st.integers(-2, 9), st.integers(-2, 9)),
)

DTYPES = [
    "?",
    "i1",
    "u1",
    "<i2",
    ">i2",
    "<i4",
    ">i4",
    "<u4",
    "<i8",
    ">i8",
    "<u8",
    "f2",
    "<f4",
    "f8",
    ">f8",
    "g",
    "c8",
]
DTYPES += ["O", "S2", "U2", "M8[s]", "m8[s]", [("a", "i1"), ("p", "i4")], "V3"]
SHAPES = [
    (),
    (0,),
    (1,),
    (2,),
    (3,),
    (0, 2),
    (2, 0),
    (1, 2),
    (2, 2),
    (3, 2),
    (2, 3),
    (4, 5),
    (6, 9),
    (1, 1, 2),
    (2, 2, 2),
]


def _strided(array):
    wide = np.zeros(tuple(2 * n for n in array.shape), dtype=array.dtype)
    part = wide[(..., *(slice(None, None, 2) for _ in array.shape))]
    part[...] = array
    return part


def _unaligned(array):
    if array.dtype.hasobject:
        return array
    raw = np.zeros(array.nbytes + 1, dtype="u1")[1:]
    part = raw.view(array.dtype).reshape(array.shape) if array.nbytes else array
    part[...] = array
    return part


def _field(array):
    record = np.zeros(array.shape, dtype=[("x", "i1"), ("here", array.dtype), ("y", "i2")])
    record["here"][...] = array
    return record["here"]


def _read_only(array):
    array = np.array(array)
    array.flags.writeable = False
    return array


def _mapped(array):
    if not array.nbytes or array.dtype.hasobject:
        return array
    file, name = tempfile.mkstemp()
    os.close(file)
    mapped = np.memmap(name, dtype=array.dtype, mode="w+", shape=array.shape)
    mapped[...] = array
    os.unlink(name)
    return mapped


def _bool_view(array):
    return (
        np.asarray(np.where(array != 0, 6, 0).astype("u1")).view(bool) if array.dtype.kind in "biu" else array
    )


LAYOUTS = {
    "plain": lambda array: array,
    "fortran": np.asfortranarray,
    "reversed": lambda array: array[(slice(None, None, -1),) * array.ndim],
    "strided": _strided,
    "unaligned": _unaligned,
    "field": _field,
    "read-only": _read_only,
    "transposed": lambda array: np.ascontiguousarray(array.T).T,
    "broadcast": lambda array: (
        np.broadcast_to(array[:1], array.shape) if array.ndim and len(array) else array
    ),
    "mapped": _mapped,
    "matrix": lambda array: np.matrix(array) if array.ndim == 2 and array.dtype.kind in "biuf" else array,
    "masked": lambda array: np.ma.masked_array(array, mask=False) if array.dtype.kind in "biuf" else array,
    "with a mask": lambda array: (
        np.ma.masked_array(array, mask=True) if array.dtype.kind in "biuf" else array
    ),
    "bool view": _bool_view,
}


@st.composite
def arrays(draw):
    """Arrays of many types, shapes and layouts; most of them hold small integers."""
    dtype, shape = np.dtype(draw(st.sampled_from(DTYPES))), draw(st.sampled_from(SHAPES))
    low, high = draw(st.sampled_from([(0, 2), (0, 5), (-1, 9), (0, 2**31), (-(2**63), 2**63 - 1)]))
    numbers = np.random.default_rng(draw(st.integers(0, 2**16))).integers(low, high, size=shape)
    with np.errstate(all="ignore"):
        if dtype.kind in "OSU":
            array = numbers.astype(dtype)
        elif dtype.kind == "V":
            array = np.zeros(shape, dtype=dtype)
        else:
            array = numbers.astype(dtype)
    if dtype.kind == "f" and array.size and draw(st.integers(0, 4)) == 0:
        array.flat[0] = draw(st.sampled_from([np.nan, np.inf, -np.inf]))
    return LAYOUTS[draw(st.sampled_from(sorted(LAYOUTS)))](np.asarray(array))


LIES = [
    None,
    -1,
    0,
    1,
    3,
    2**31,
    2**62,
    2**70,
    "x",
    0.5,
    float("nan"),
    [],
    (1, 3),
    np.zeros((2, 2)),
    EvilError,
]
MAGIC = [
    "__index__",
    "__int__",
    "__float__",
    "__len__",
    "__array__",
    "__iter__",
    "__getitem__",
    "__str__",
    "__repr__",
]
MAGIC += [
    "__bool__",
    "__fspath__",
    "__call__",
    "__eq__",
    "__hash__",
    "__contains__",
    "__next__",
    "__array_interface__",
]
MAGIC += [
    "__buffer__",
    "__array_struct__",
    "__array_ufunc__",
    "shape",
    "dtype",
    "ndim",
    "_mask",
    "__complex__",
]
BASES = [object, int, float, str, list, tuple, dict, bytes, set, np.ndarray]


def _method(name, lie):
    calls = iter(range(9))

    def method(self, *_, **__):
        if lie is EvilError:
            raise EvilError(name)
        # A sequence without an end would be read without an end, by Python itself, too.
        if name in ("__getitem__", "__next__") and next(calls, None) is None:
            raise IndexError if name == "__getitem__" else StopIteration
        return lie

    return property(method) if name in ("shape", "dtype", "ndim", "_mask", "__array_interface__") else method


@st.composite
def evil_objects(draw):
    """Objects of any base whose methods raise or lie."""
    base = draw(st.sampled_from(BASES))
    lies = draw(st.dictionaries(st.sampled_from(MAGIC), st.sampled_from(LIES), min_size=1, max_size=4))
    methods = {name: _method(name, lie) for name, lie in lies.items()}
    kind = type("Evil", (base,), methods)
    values = {int: 2, float: 2.0, str: "any", list: [1, 3], tuple: (1, 3), bytes: b"abc"}
    try:
        if base is np.ndarray:
            return np.array([[1, 3], [0, 4]]).view(kind)
        return kind(values[base]) if base in values else kind()
    except (EvilError, TypeError, ValueError, OverflowError, AttributeError):
        return kind.__new__(kind)


def evil_pairs():
    """Evil objects as rows, columns and points of sequences."""
    return st.one_of(
        st.tuples(st.integers(0, 3), evil_objects()),
        st.lists(evil_objects(), min_size=1, max_size=2),
        st.lists(st.tuples(evil_objects(), st.integers(0, 3)), min_size=1, max_size=2),
    )


VALUES = st.one_of(NUMBERS, OTHERS, arrays(), arrays(), evil_objects(), evil_pairs())
