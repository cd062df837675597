"""Inputs and intermediate computations that several questions share.

They concern the sky, times, poles, and settings for an accuracy.

Parts convert between labelled data and the arrays of the physics packages. They import modules when
they run, so that a question loads only the modules that it needs.
"""
