"""Tools that measure or check the data that the package carries; not part of the wheel.

Run them as ``python -m data_tools VERB``.
"""
