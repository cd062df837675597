"""What is asked for, and only that: scenes, plans, parts."""
