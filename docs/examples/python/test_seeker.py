"""Requirements of a seeker's estimator, as tests."""

import pytest

SCENARIO = "../../../bench/flights/los_quick.toml"


@pytest.mark.requirement("SEEKER-1")
def test_the_missile_hits(bench):
    run = bench.run(SCENARIO)
    assert run.judgement("miss_distance").value < 0.1


@pytest.mark.requirement("SEEKER-2")
@pytest.mark.parametrize("noise_mrad", [1, 2])
def test_noise_is_filtered(bench, noise_mrad):
    run = bench.run(SCENARIO, set={"seeker.constant_noise_mrad": noise_mrad})
    errors = run.series("los.rate.pitch").error
    assert max(map(abs, errors[400:800])) < 0.015
