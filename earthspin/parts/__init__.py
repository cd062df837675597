"""Parts that questions share: the sky, times, poles, and what an accuracy asks for.

Parts carry data across the border between labelled data and physics. What they call is imported
when they run, so that a question loads only what it needs.
"""
