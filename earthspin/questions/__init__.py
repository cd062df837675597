"""What can be asked: one file a question, with its class, its own parts and its sections."""
