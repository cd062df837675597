"""Independent solvers, used as references by self-checks and tests of the package's solvers."""
