"""Questions, the parts that answer them, plans, runs, labels and files; no physics, no sky."""
