"""Framework without physics: questions, parts, plans, runs, labels and files."""
