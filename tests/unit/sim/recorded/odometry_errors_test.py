# SPDX-License-Identifier: GPL-3.0-or-later
"""The estimates that odometry_table.py makes, against robots whose errors are known."""
import gzip
import io
import math
import pathlib
import random
import tempfile
import unittest

import odometry_errors
import odometry_logs
import odometry_table

WAY_PER_METRE, TURN_PER_RAD, TURN_PER_METRE = -0.03, 0.02, 0.01
WAY_SIGMA, TURN_SIGMA, NOISE = 0.02, 0.03, 0.005


def true_motion(stream, motion):
    """How a robot with the errors above really moves, of which the odometry sees a motion with an arc's middle direction."""
    way, turn = math.hypot(motion[0], motion[1]), motion[2]
    true_way = way * (1.0 + WAY_PER_METRE) + stream.gauss(0.0, WAY_SIGMA * math.sqrt(way))
    true_turn = turn * (1.0 + TURN_PER_RAD) + TURN_PER_METRE * way + stream.gauss(0.0, TURN_SIGMA * math.sqrt(abs(turn)))
    return true_way * math.cos(turn / 2.0), true_way * math.sin(turn / 2.0), true_turn + stream.gauss(0.0, NOISE)


def steps_of_a_robot(seed, count):
    stream = random.Random(seed)
    steps = []
    for _ in range(count):
        way, turn = stream.uniform(0.0, 1.0), stream.uniform(-0.6, 0.6)
        motion = way * math.cos(turn / 2.0), way * math.sin(turn / 2.0), turn
        steps.append((motion, true_motion(stream, motion)))
    return steps


def seen_from_a_sensor(motion, ahead, left):
    """The motion of a sensor that is mounted on the robot."""
    place = (ahead, left, 0.0)
    return odometry_logs.joined(odometry_logs.joined(odometry_logs.reversed_motion(place), motion), place)


class Estimates(unittest.TestCase):
    def test_the_errors_of_a_known_robot_are_found(self):
        errors = odometry_errors.errors_of_log(steps_of_a_robot(1, 4000))
        for name, right, tolerance in (("way_per_metre", WAY_PER_METRE, 0.002), ("turn_per_rad", TURN_PER_RAD, 0.003),
                                       ("turn_per_metre", TURN_PER_METRE, 0.001), ("way_sigma_metre", WAY_SIGMA, 0.002),
                                       ("turn_sigma_rad", TURN_SIGMA, 0.003), ("turn_sigma_constant", NOISE, 0.003)):
            with self.subTest(name):
                value, low, high = errors[name]
                self.assertAlmostEqual(value, right, delta=tolerance)
                self.assertTrue(low <= value <= high)

    def test_about_95_percent_of_intervals_hold_the_truth(self):
        hits = 0
        for seed in range(40):
            _, low, high = odometry_errors.errors_of_log(steps_of_a_robot(seed, 500), draws=300)["way_per_metre"]
            hits += low <= WAY_PER_METRE <= high
        self.assertTrue(33 <= hits, hits)  # a binomial of 40 times 95 % is there with probability 0.999

    def test_the_place_of_the_sensor_is_no_error(self):
        steps = [(motion, seen_from_a_sensor(motion, 0.2, -0.1)) for motion, _ in steps_of_a_robot(3, 200)]
        errors = odometry_errors.errors_of_log(steps)
        for name in odometry_errors.SYSTEMATIC + odometry_errors.RANDOM:
            self.assertAlmostEqual(errors[name][0], 0.0, delta=1e-6, msg=name)

    def test_robots_of_a_level_differ_by_their_own_errors(self):
        runs = []
        for seed in range(40):
            scale = 1.0 + 0.001 * (seed - 20)
            runs.append([((motion[0], motion[1], 0.0), (motion[0] * scale, motion[1] * scale, 0.0))
                         for motion in [(1.0, 0.0)] * 30])
        value, low, high = odometry_errors.errors_of_level(runs)["way_per_metre"]
        self.assertAlmostEqual(value, -0.0005, places=9)
        self.assertAlmostEqual(low, -0.019, places=9)
        self.assertAlmostEqual(high, 0.019, places=9)


class Logs(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def write(self, name, text):
        path = pathlib.Path(self.folder.name) / name
        with gzip.open(path, "wt", encoding="ascii") as file:
            file.write(text)
        return path

    def assert_motion(self, motion, right):
        for part, right_part in zip(motion, right):
            self.assertAlmostEqual(part, right_part, places=9)

    def test_scans_are_pairs_of_poses(self):
        path = self.write("scans", "# t ...\n1 0 0 1.5707963267948966 5 5 0 9.9\n2 0 1 1.5707963267948966 6.5 5 0 9.9\n")
        (odometry, reference), = odometry_logs.steps_of_scans(path)
        self.assert_motion(odometry, (1.0, 0.0, 0.0))
        self.assert_motion(reference, (1.5, 0.0, 0.0))

    def test_a_corrected_log_leads_on_by_odometry_from_each_corrected_pose(self):
        scan = "FLASER 1 9.9 {0} 0 0 {0} 0 0 {1} host {1}\n"
        odometry = "ODOM {} 0 0 0 0 0 {} host {}\n"
        log = scan.format(10, 1) + odometry.format(10.9, 2, 2) + scan.format(11, 2)
        log += odometry.format(11, 0, 0) + odometry.format(11.4, 3, 3) + scan.format(12, 4)  # no ODOM with stamp 4
        (measured, reference), = odometry_logs.steps_of_carmen_log(self.write("log", log))
        self.assert_motion(measured, (0.9, 0.0, 0.0))
        self.assert_motion(reference, (1.0, 0.0, 0.0))

    def test_relations_are_followed_both_ways_and_not_out_of_the_time(self):
        scans = self.write("scans", "1 0 0 0 0 0 0\n3 1 0 0 1 0 0\n4 2 0 0 2 0 0\n")
        ties = self.write("ties", "1 2 0.4 0 0 0 0 0\n3 2 -0.7 0 0 0 0 0\n3 9 1 0 0 0 0 0\n9 4 1 0 0 0 0 0\n")
        (measured, reference), = odometry_logs.steps_of_relations(scans, ties)
        self.assert_motion(measured, (1.0, 0.0, 0.0))
        self.assert_motion(reference, (1.1, 0.0, 0.0))

    def test_runs_are_read_by_seed_from_where_they_begin(self):
        text = "seed,odometry_x,odometry_y,odometry_yaw,true_x,true_y,true_yaw\n1,1,0,0,2,0,0\n1,2,0,0,3,0,0\n7,1,0,0,1,0,0\n"
        runs = odometry_logs.steps_of_runs(io.StringIO(text))
        self.assertEqual([len(steps) for steps in runs.values()], [2, 1])
        self.assert_motion(runs["1"][1][1], (1.0, 0.0, 0.0))
        self.assert_motion(runs["7"][0][0], (1.0, 0.0, 0.0))


class Table(unittest.TestCase):
    def test_a_log_has_the_least_level_that_covers_it(self):
        levels = {"ideal": {"way_per_metre": (0.0, 0.0, 0.0), "way_sigma_metre": (0.0, 0.0, 0.0)},
                  "nominal": {"way_per_metre": (0.0, -0.01, 0.01), "way_sigma_metre": (0.5, 0.4, 0.6)},
                  "harsh": {"way_per_metre": (0.0, -0.02, 0.02), "way_sigma_metre": (1.0, 0.9, 1.1)},
                  "recorded": {"way_per_metre": (0.0, -0.024, 0.024), "way_sigma_metre": (1.1, 1.0, 1.15)}}
        for log, name, right in (((-0.005, -0.006, -0.004), "way_per_metre", "nominal"),
                                 ((-0.02, -0.03, -0.015), "way_per_metre", "harsh"),
                                 ((0.025, 0.022, 0.028), "way_per_metre", "recorded"),
                                 ((0.001, -0.001, 0.003), "way_per_metre", "any"),
                                 ((0.03, 0.025, 0.035), "way_per_metre", "beyond"),
                                 ((0.2, 0.1, 0.3), "way_sigma_metre", "nominal"),
                                 ((1.2, 1.0, 1.3), "way_sigma_metre", "harsh"),
                                 ((1.3, 1.2, 1.4), "way_sigma_metre", "beyond")):
            self.assertEqual(odometry_table.least_level(levels, {name: log}, name), right)


if __name__ == "__main__":
    unittest.main()
