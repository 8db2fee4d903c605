# SPDX-License-Identifier: GPL-3.0-or-later
"""Estimates what is wrong with an odometry from steps of it beside the truth (odometry_logs.py).

Model of a step that goes `way` [m] forward and turns by `turn` [rad], by its odometry:
    true turn - turn = turn_per_rad * turn + turn_per_metre * way + noise
    true way  - way  = way_per_metre * way + noise + what the sensor's place adds when it turns
The variance of either noise is constant + per_metre * |way| + per_rad * |turn|, none of them negative. The constant part is
what the step does not make: the noise of the reference. Both ways are measured in the direction of the middle of the turn.
"""
import itertools
import math
import random

SYSTEMATIC = ("way_per_metre", "turn_per_rad", "turn_per_metre")
RANDOM = ("way_sigma_metre", "way_sigma_rad", "way_sigma_constant", "turn_sigma_metre", "turn_sigma_rad",
          "turn_sigma_constant")
BLOCK = 20    # successive steps that are drawn together: the noise of a reference's pose is in two steps
DRAWS = 2000
SEED = 1


class Equations:
    """Sums of linear equations x . c = y for least squares; those of several blocks may be added."""

    def __init__(self, size):
        self.matrix = [[0.0] * size for _ in range(size)]
        self.right = [0.0] * size
        self.square = 0.0

    def take(self, x, y):
        for i, left in enumerate(x):
            self.right[i] += left * y
            for j, right in enumerate(x):
                self.matrix[i][j] += left * right
        self.square += y * y

    def add(self, other):
        for i, row in enumerate(other.matrix):
            self.right[i] += other.right[i]
            for j, value in enumerate(row):
                self.matrix[i][j] += value
        self.square += other.square

    def solution(self, used=None):
        """The coefficients, by Gauss and Jordan; those not used are 0, and so is one that no equation has."""
        used = range(len(self.right)) if used is None else used
        rows = [[self.matrix[i][j] for j in used] + [self.right[i]] for i in used]
        for i, pivot in enumerate(rows):
            for row in rows:
                if row is not pivot and pivot[i] != 0.0:
                    factor = row[i] / pivot[i]
                    row[:] = [a - factor * b for a, b in zip(row, pivot)]
        result = [0.0] * len(self.right)
        for i, column in enumerate(used):
            result[column] = rows[i][-1] / rows[i][i] if rows[i][i] != 0.0 else 0.0
        return result

    def residual(self, c):
        quadratic = sum(c[i] * c[j] * value for i, row in enumerate(self.matrix) for j, value in enumerate(row))
        return quadratic - 2.0 * sum(a * b for a, b in zip(c, self.right)) + self.square

    def solution_without_negatives(self):
        """The best of the solutions with some coefficients left out, of which none is negative."""
        size = len(self.right)
        subsets = itertools.chain.from_iterable(itertools.combinations(range(size), n) for n in range(size + 1))
        solutions = (self.solution(subset) for subset in subsets)
        return min((c for c in solutions if min(c) >= 0.0), key=self.residual)


def rows_of(steps):
    """[(way, turn, error of the way, error of the turn, twice the sine of half the turn)]"""
    rows = []
    for (forward, left, turn), (true_forward, true_left, true_turn) in steps:
        c, s = math.cos(turn / 2.0), math.sin(turn / 2.0)
        way = c * forward + s * left
        error = true_turn - turn
        rows.append((way, turn, c * true_forward + s * true_left - way, math.atan2(math.sin(error), math.cos(error)), 2.0 * s))
    return rows


def blocks_of(steps, size=BLOCK):
    rows = rows_of(steps)
    return [rows[i:i + size] for i in range(0, len(rows), size)]


def systematic_equations(block):
    ways, turns = Equations(2), Equations(2)
    for way, turn, way_error, turn_error, swing in block:
        ways.take((way, swing), way_error)
        turns.take((turn, way), turn_error)
    return ways, turns


def random_equations(block, ways, turns):
    """Squares of what the systematic part leaves."""
    way_squares, turn_squares = Equations(3), Equations(3)
    for way, turn, way_error, turn_error, swing in block:
        x = abs(way), abs(turn), 1.0
        way_squares.take(x, (way_error - ways[0] * way - ways[1] * swing) ** 2)
        turn_squares.take(x, (turn_error - turns[0] * turn - turns[1] * way) ** 2)
    return way_squares, turn_squares


def total(pairs):
    """The sums of the first and of the second equations of all pairs."""
    pairs = list(pairs)
    sums = Equations(len(pairs[0][0].right)), Equations(len(pairs[0][1].right))
    for pair in pairs:
        for whole, part in zip(sums, pair):
            whole.add(part)
    return sums


def solve_systematic(pairs):
    ways, turns = (equations.solution() for equations in total(pairs))
    return ways, turns


def systematic(pairs):
    ways, turns = solve_systematic(pairs)
    return dict(zip(SYSTEMATIC, (ways[0], turns[0], turns[1])))


def deviations(pairs):
    ways, turns = (equations.solution_without_negatives() for equations in total(pairs))
    return dict(zip(RANDOM, (math.sqrt(variance) for variance in ways + turns)))


def percentiles(values):
    """The bounds of the middle 95 %."""
    values = sorted(values)
    return values[int(0.025 * len(values))], values[min(len(values) - 1, int(0.975 * len(values)))]


def intervals(estimate, parts, draws=DRAWS):
    """{name: (low, high)} of an estimate from parts that are drawn with replacement."""
    stream = random.Random(SEED)
    drawn = [estimate(stream.choices(parts, k=len(parts))) for _ in range(draws)]
    return {name: percentiles([one[name] for one in drawn]) for name in drawn[0]}


def errors_of_log(steps, draws=DRAWS):
    """{name: (estimate, low, high)} of one robot, with the 95 % interval of the estimate."""
    blocks = blocks_of(steps)
    regular = [systematic_equations(block) for block in blocks]
    ways, turns = solve_systematic(regular)
    left = [random_equations(block, ways, turns) for block in blocks]
    result = {}
    for estimate, parts in ((systematic, regular), (deviations, left)):
        bounds = intervals(estimate, parts, draws)
        result |= {name: (value, *bounds[name]) for name, value in estimate(parts).items()}
    return result


def errors_of_level(runs):
    """{name: (estimate, low, high)} of many robots.

    Each robot has its own systematic errors: the mean, and the bounds of 95 % of the robots. The random part is that of all
    robots together, with its 95 % interval over robots.
    """
    each, left = [], []
    for steps in runs:
        rows = rows_of(steps)
        regular = systematic_equations(rows)
        each.append(systematic([regular]))
        left.append(random_equations(rows, *solve_systematic([regular])))
    result = {name: (sum(one[name] for one in each) / len(each), *percentiles([one[name] for one in each])) for name in SYSTEMATIC}
    bounds = intervals(deviations, left)
    return result | {name: (value, *bounds[name]) for name, value in deviations(left).items()}
