"""What Sun, Moon and planets do to the bulge (I.8)."""
