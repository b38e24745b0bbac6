"""Tests the verdict of the soak on artificial series of memory sizes and numbers of descriptors."""

import random
import sys
import unittest

sys.dont_write_bytecode = True
import soak  # noqa: E402  (found beside this file)


def course(values, name="target memory", sorts=("any",)):
    made = soak.courses()[name]
    for i, value in enumerate(values):
        made.add(sorts[i % len(sorts)], value)
    return made


class Courses(unittest.TestCase):
    def test_noise_about_a_level_is_flat(self):
        noise = random.Random(1)
        self.assertFalse(course([5000 + noise.randint(-60, 60) for _ in range(200)]).grows())

    def test_what_is_taken_at_the_start_is_no_growth(self):
        self.assertFalse(course([1000 + 400 * min(i, 8) for i in range(40)]).grows())

    def test_a_leak_of_a_kibibyte_a_run_is_found_beneath_the_noise(self):
        noise = random.Random(1)
        leaking = course([5000 + i + noise.randint(-60, 60) for i in range(400)])
        self.assertTrue(leaking.grows())
        self.assertAlmostEqual(leaking.slope(), 1, delta=0.1)

    def test_one_descriptor_that_stays_is_found(self):
        self.assertTrue(course([7] * 20 + [8] * 20, "target descriptors").grows())
        self.assertFalse(course([7] * 40, "target descriptors").grows())

    def test_sorts_of_runs_that_take_turns_are_no_growth(self):
        self.assertFalse(course([9000, 30000] * 20, "bench memory", ("short", "long")).grows())

    def test_a_peak_in_one_run_is_no_growth(self):
        self.assertFalse(course([7] * 30 + [9] + [7] * 9, "target descriptors").grows())


if __name__ == "__main__":
    unittest.main()
