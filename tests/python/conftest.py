"""One flight for all tests that only look at results."""

from pathlib import Path

import canhil
import pytest

SOURCE = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def scenario() -> Path:
    return SOURCE / "bench/flights/los_quick.toml"


@pytest.fixture(scope="session")
def flown(scenario: Path) -> canhil.Run:
    return canhil.run(scenario, bus="in-process")
