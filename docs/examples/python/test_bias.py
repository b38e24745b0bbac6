"""A test that fails: the estimator cannot know that its seeker is wrong."""


def test_a_bias_does_not_matter(bench):
    bias = {"name": "bias", "kind": "bias", "quantity": "seeker.error_pitch", "by_mrad": 4, "from_s": 2.5, "to_s": 2.7}
    run = bench.run("../../../bench/flights/los_quick.toml", faults=[bias])
    bench.check(run)
