"""Framework without physics: it runs the functions behind each question and stores the results."""
