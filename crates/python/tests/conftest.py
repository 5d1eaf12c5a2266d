"""Fixtures of all tests: seeds that are printed when a test fails."""

import os

import numpy as np
import pytest

SEED = int(os.environ.get("MEDIANT_SEED", "20250801"))


@pytest.fixture
def rng(request):
    """A random generator of the test's own. `MEDIANT_SEED` sets another seed."""
    numbers = [SEED, *request.node.name.encode()]
    print(f"MEDIANT_SEED={SEED}")
    return np.random.default_rng(numbers)


@pytest.fixture
def empty_cache():
    """No index of another test is in the cache of `mediant.batch`."""
    from mediant import batch

    batch.cache.clear()
    yield
    batch.cache.clear()
