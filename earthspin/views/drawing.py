"""A figure ready for the page."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Drawing:
    """A figure ready for the page.

    Attributes
    ----------
    title, caption : str
    svg : str
        Text of the picture, without an XML head.
    square : bool
        Whether it is as high as wide, and is then drawn narrower.
    """

    title: str
    caption: str
    svg: str
    square: bool = False
