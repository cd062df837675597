"""Model of UT1 against brute-force conditioning, and its variances against draws."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from earthspin.constants import NORMAL_95
from earthspin.numerics.arrays import FloatArray
from earthspin.wobble import ut1_forecast as rotation
from earthspin.wobble.forecast import RECORD
from earthspin.wobble.state_space import Filter


def test_a_step_is_the_solution_of_the_equations() -> None:
    """Seasons, two filters in series, and UT1 as minus the integral of the length of day."""

    def rates(_: float, state: FloatArray) -> list[float]:
        _, slow, first, second, *circles = state
        year = 2 * np.pi / 365.2422
        seasons = [
            value
            for number, (cosine, sine) in enumerate(
                zip(circles[::2], circles[1::2], strict=True), 1
            )
            for value in (-number * year * sine, number * year * cosine)
        ]
        day = slow + second + sum(circles[::2])
        filters = [-first / rotation.FIRST_MEMORY, (first - second) / rotation.SECOND_MEMORY]
        return [-day, 0.0, *filters, *seasons]

    start = np.random.default_rng(3).normal(size=10)
    solved = solve_ivp(rates, (0, 1), start, rtol=1e-11, atol=1e-12).y[:, -1]
    assert np.allclose(rotation.model().transition @ start, solved, rtol=0, atol=1e-9)


def test_the_fast_part_keeps_its_standard_deviation() -> None:
    """The first filter has the variance FAST**2; the second that share of it that it lets pass."""
    system, covariance = rotation.model(), np.zeros((10, 10))
    for _ in range(200):
        covariance = system.propagated(covariance)
    first, second = rotation.FIRST_MEMORY, rotation.SECOND_MEMORY
    assert covariance[2, 2] == pytest.approx(rotation.FAST**2, rel=1e-9, abs=0)
    assert covariance[3, 3] == pytest.approx(
        rotation.FAST**2 * first / (first + second), rel=1e-9, abs=0
    )


@pytest.fixture(scope="module")
def simulated() -> FloatArray:
    """Records of UT1 drawn from the model, with 30 days after each, shape (40, n)."""
    generator, system = np.random.default_rng(11), rotation.model()
    root, state = np.linalg.cholesky(system.noise + 1e-18 * np.eye(10)), np.zeros((40, 10))
    state[:, [2, 3]] = rotation.FAST * generator.normal(size=(40, 2))
    records = np.empty((40, RECORD + 30))
    for day in range(RECORD + 30):
        state = state @ system.transition.T + generator.normal(size=(40, 10)) @ root.T
        records[:, day] = state[:, 0] + rotation.OBSERVATION * generator.normal(size=40)
    return records


def test_deviations_are_those_of_drawn_errors(simulated: FloatArray) -> None:
    """Over 40 records, standard deviations scatter by 11 %; bounds are three times that."""
    errors, days, stated = [], [], []
    for record in simulated:
        constant = np.full(RECORD, rotation.OBSERVATION)
        ahead = rotation.forecast(record[:RECORD], constant, 28)
        true = record[RECORD:]
        errors.append(ahead.ut1[0] - true[:28])
        days.append(ahead.length_of_day[0, 1:] - (true[:27] - true[2:29]) / 2)
        stated.append(np.array([ahead.ut1[1], ahead.length_of_day[1]]) / NORMAL_95)
    ut1, day = np.mean(stated, axis=0)
    for horizon in (1, 3, 10, 28):
        ratio = np.sqrt(np.mean(np.square(errors), axis=0))[horizon - 1] / ut1[horizon - 1]
        assert 0.6 < ratio < 1.35
    assert np.all(abs(np.sqrt(np.mean(np.square(days), axis=0)) / day[1:] - 1) < 0.4)


def test_the_seventh_day_against_conditioning() -> None:
    """The update equals that of the joint Gaussian distribution of state, UT1 and its change."""
    generator, system = np.random.default_rng(5), rotation.model()
    half = generator.normal(size=(10, 10))
    covariance, state = half @ half.T, generator.normal(size=10)
    predicted = generator.normal(size=7)
    found, spread = rotation._with_seventh_day(system, state, covariance, predicted)
    before = np.linalg.solve(system.transition.T, np.eye(10)[0])
    rows = np.array([np.eye(10)[0], np.eye(10)[0] - before])
    ut1, change = rotation.BULLETIN_A_ERRORS[0, -1], rotation.BULLETIN_A_CHANGE
    across = rotation.BULLETIN_A_CORRELATION * ut1 * change
    error = np.array([[ut1**2, across], [across, change**2]])
    information = np.linalg.inv(covariance) + rows.T @ np.linalg.inv(error) @ rows
    data = np.array([predicted[6], predicted[6] - predicted[5]])
    weighted = np.linalg.solve(covariance, state) + rows.T @ np.linalg.solve(error, data)
    assert np.allclose(spread, np.linalg.inv(information), rtol=0, atol=1e-8)
    assert np.allclose(found, np.linalg.solve(information, weighted), rtol=0, atol=1e-8)


def test_days_of_bulletin_a_are_its_own(simulated: FloatArray) -> None:
    record, seven = simulated[0, :RECORD], simulated[0, RECORD : RECORD + 7] + 0.2
    constant = np.full(RECORD, rotation.OBSERVATION)
    given = rotation.forecast(record, constant, 20, 0, seven)
    alone = rotation.forecast(record, constant, 20, 0)
    assert np.allclose(given.ut1[0, :7], seven, rtol=0, atol=1e-9)
    assert np.all(given.ut1[1] < alone.ut1[1])
    assert np.allclose(given.length_of_day[0, 1:5], (seven[:4] - seven[2:6]) / 2, rtol=0, atol=1e-9)
    short = rotation.forecast(record, constant, 3, 0, seven)
    assert np.array_equal(short.ut1, given.ut1[:, :3])
    assert np.array_equal(short.length_of_day, given.length_of_day[:, :3])


def test_inaccurate_rows_count_less() -> None:
    """A filter with an error for each row is that of the information it adds."""
    system = rotation.model()
    errors = np.array([0.1, 2.0, 0.5, 1e4])[:, None, None] ** 2
    data = np.array([[3.0], [2.0], [4.0], [-1e3]])
    state, _ = Filter.of(system, 4, errors).run(data)
    shorter, _ = Filter.of(system, 3, errors[:3]).run(data[:3])
    assert np.allclose(state, system.transition @ shorter, rtol=0, atol=0.06)
