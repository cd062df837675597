"""Response of a body's interior to nutation torques, predicted from its layers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from earthspin.bodies import Body, in_a_sentence
from earthspin.engine.part import part
from earthspin.interior.diurnal_ocean import FES2004_SOURCE
from earthspin.interior.named import ANELASTIC_EXPONENT, Interior
from earthspin.interior.published import CORE_NUTATION, K_CMB_OUT_OF_PHASE
from earthspin.numerics.arrays import ComplexArray, FloatArray
from earthspin.nutation import ladder
from earthspin.parts.layered import interior_of, of_another_body
from earthspin.parts.reasons import no_iau_model
from earthspin.wobble.ladder import Spin

#: The rung that is used if a question needs a single predicted response.
CHOSEN = "core-ellipticity"
#: Sources of the numbers that a prediction uses besides the layers.
SOURCES = "; ".join(
    (CORE_NUTATION.source, K_CMB_OUT_OF_PHASE.source, FES2004_SOURCE, ANELASTIC_EXPONENT.source)
)


@dataclass(frozen=True)
class Prediction:
    """Predicted response of a body's interior, from models of increasing detail (rungs).

    Attributes
    ----------
    rungs : dict of str to Rung
        Rungs of the ladder, and additional models.
    setting : Setting
        Inputs that the models share.
    uncertainty : mapping of str to float
        Relative standard uncertainties of the numbers of the interior, and of e.
    """

    rungs: dict[str, ladder.Rung]
    setting: ladder.Setting
    uncertainty: Mapping[str, float]

    @property
    def ladder(self) -> list[str]:
        """Names of the models in order of detail (rungs), except those used only for comparison."""
        return [name for name in self.rungs if name not in ladder.BESIDE]

    def transfer(self, name: str, frequency: FloatArray) -> ComplexArray:
        """Transfer function (non-rigid over rigid nutation) of one model, at frequencies in rad/s.

        The frequencies are in space.
        """
        sigma = frequency / self.setting.spin_rate - 1
        return self.rungs[name].transfer(sigma, self.setting.e)


def layered(body: Body) -> Interior | None:
    """Return the interior of a body whose layers include an inner core; else None."""
    interior = interior_of(body)
    if interior is None or interior.layers is None or not interior.layers.inner_core_radius:
        return None
    return interior


def no_layers(body: Body) -> str | None:
    """Return the reason (text) to omit the prediction if the body is unsuitable, else None.

    The body needs an IAU model, and layers with an inner core that have its mass and radius.
    """
    if no_iau_model(body):
        return no_iau_model(body)
    interior = layered(body)
    if interior is None:
        return f"no layers with an inner core are known for {in_a_sentence(body.name)}"
    assert interior.layers is not None
    return of_another_body(interior.layers, body)


def predict(body: Body, coupling: bool, anelastic_exponent: float) -> Prediction:
    """Build all interior models (rungs) of a body with layers."""
    interior = layered(body)
    assert interior is not None
    assert interior.layers is not None
    h, spin_rate = body.number("dynamical_flattening"), float(body.spin_rate)
    e, ocean = h / (1 - h), 0.0
    if interior.ocean is not None:
        spin = Spin(body.number("gm"), body.number("radius"), body.number("spin_period"))
        mean = (interior.ocean[0][0] + interior.ocean[1][1]) / 2
        ocean = mean / spin.centrifugal(interior.layers.radius)
    setting = ladder.Setting(interior.layers, e, spin_rate, ocean, anelastic_exponent)
    rungs = ladder.climb(setting, coupling)
    of_e = body.relative_uncertainty.get("dynamical_flattening", 0.0) / (1 - h)
    return Prediction(rungs, setting, {**interior.relative_uncertainty, "ellipticity": of_e})


@part(unless=no_layers)
def prediction(body: Body) -> Prediction:
    """Predict the response of the interior from its layers."""
    return predict(body, False, ANELASTIC_EXPONENT.value)
