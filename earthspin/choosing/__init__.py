"""Accuracy on request: the cheapest settings whose measured error is small enough.

What each setting costs in error was measured once on the sky alone (`python -m data_tools
error-models` writes `error_models.json`); what it does to a body follows from `motion.sampling` and
`torque.average`. Where the sky is not in the table (another perturber, another body), nothing is
chosen and the finest settings stand.
"""
