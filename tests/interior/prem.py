"""PREM as published, with a global ocean of 3 km."""

from dataclasses import replace

from earthspin.interior.layers import PREM, Layer

CRUST = replace(PREM.layers[-1], top=6368e3)
PREM_WITH_OCEAN = replace(
    PREM, name="prem-ocean", layers=(*PREM.layers[:-1], CRUST, Layer(6371e3, (1020.0,), (1450.0,)))
)
