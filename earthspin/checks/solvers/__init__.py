"""Solvers that share no method with the package, as references for cases, ladders and tests."""
