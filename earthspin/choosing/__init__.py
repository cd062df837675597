"""Choose for each method the cheapest settings whose measured error meets a requested accuracy.

The errors of all settings were measured on positions and torques of the shipped bodies (`python -m
data_tools error-models` writes `error_models.json`). The resulting errors of a body's axis follow
from `motion.sampling` and `torque.average`. If the table does not contain a body or perturber, no
settings are chosen and the finest are used.
"""
