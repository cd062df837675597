"""One small adapter per part: what it needs, gives and calls, and the schema of what it gives.

Adapters carry data across the border between labelled data and physics; they do no
arithmetic of their own. These files import nothing heavy: what a part calls is imported
when it runs.
"""

from __future__ import annotations

from earthspin.scene.part import Part
from earthspin.scene.parts import (
    accuracies,
    averaging,
    axes_in_time,
    choices,
    core_response,
    earth_models,
    free_wobble,
    iau_comparison,
    kernel,
    ladder,
    nutation_nodes,
    nutation_terms,
    observed_pole,
    pole_analysis,
    pole_budget,
    pole_residuals,
    precession_polynomials,
    pulls,
    rotation,
    seasons,
    spheroid_points,
    standstills,
    tops,
    torque_at_times,
)

#: Every part there is, by name.
PARTS: dict[str, Part] = {
    part.name: part
    for part in (
        kernel.EPHEMERIS,
        choices.CHOSEN_NUTATION,
        nutation_nodes.NUTATION,
        choices.CHOSEN_AVERAGE,
        averaging.TORQUE_SAMPLES,
        averaging.MEAN_RATES,
        accuracies.RATE_ACCURACY,
        averaging.CONVERGENCE,
        earth_models.EARTH_MODELS,
        free_wobble.FREE_WOBBLE,
        free_wobble.OBSERVED_WOBBLE,
        seasons.SEASONS,
        iau_comparison.IAU_2006_COMPARISON,
        standstills.STANDSTILLS,
        torque_at_times.TIMES,
        torque_at_times.TORQUE_SERIES,
        accuracies.SERIES_ACCURACY,
        ladder.WOBBLE_LADDER,
        rotation.FREE_ROTATION,
        accuracies.ROTATION_ACCURACY,
        rotation.POINSOT,
        tops.HEAVY_TOP,
        accuracies.TOP_ACCURACY,
        spheroid_points.SPHEROID_FIELD,
        accuracies.FIELD_ACCURACY,
        ladder.INTERIOR_RESPONSE,
        ladder.WOBBLE_SENSITIVITY,
        observed_pole.POLAR_MOTION,
        observed_pole.CHANDLER,
        pulls.PULLS,
        choices.CHOSEN_WINDOWS,
        axes_in_time.AXIS_PATH,
        axes_in_time.POLE,
        accuracies.POLE_ACCURACY,
        axes_in_time.POLE_ANGLES,
        pole_analysis.POLE_ANALYSIS,
        core_response.CORE_RESPONSE,
        core_response.NONRIGID_SHIFT,
        pole_budget.IAU_BUDGET,
        pole_residuals.IAU_RESIDUALS,
        nutation_terms.NUTATION_TABLE,
        core_response.CORE_RESONANCE,
        precession_polynomials.PRECESSION_ANGLES,
        pole_budget.INFERRED,
    )
}
