"""Confidence intervals of the judges of the evaluation: Student's t by its density, not by a table."""

import math
from functools import cache


@cache
def quantile(freedom):
    """97.5 % of Student's t: the density is summed up by Simpson's rule, the quantile found by halving."""
    scale = math.exp(math.lgamma((freedom + 1) / 2) - math.lgamma(freedom / 2))
    scale /= math.sqrt(freedom * math.pi)
    density = lambda x: scale * (1 + x * x / freedom) ** (-(freedom + 1) / 2)

    def below(t, steps=4000):
        width = t / steps
        inner = sum((4 if i % 2 else 2) * density(i * width) for i in range(1, steps))
        return 0.5 + width / 3 * (density(0) + inner + density(t))

    low, high = 0.0, 20.0
    while high - low > 1e-6:
        middle = (low + high) / 2
        low, high = (middle, high) if below(middle) < 0.975 else (low, middle)
    return low


def interval(values):
    """The 95 % confidence interval of the mean of these."""
    count, mean = len(values), sum(values) / len(values)
    if count < 2:
        return -math.inf, math.inf
    sd = math.sqrt(sum((it - mean) ** 2 for it in values) / (count - 1))
    half = quantile(count - 1) * sd / math.sqrt(count)
    return mean - half, mean + half


def less(a, factor, b):
    """Of a less factor times b, seed by seed."""
    return [x - factor * y for x, y in zip(a, b)]


def within(values, least, most):
    """Whether the mean is between these: met, notMet or undecided."""
    low, high = interval(values)
    if least <= low and high <= most:
        return "met"
    return "notMet" if high < least or most < low else "undecided"


def above(values, bound=0):
    low, high = interval(values)
    return "met" if low > bound else "notMet" if high <= bound else "undecided"


def below(values, bound=0):
    return above([-it for it in values], -bound)


def every(outcomes):
    """One that is not met decides, and then one that is undecided."""
    outcomes = set(outcomes)
    return next((it for it in ("notMet", "undecided") if it in outcomes), "met")
