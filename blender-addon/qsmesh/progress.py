# SPDX-License-Identifier: GPL-3.0-or-later
"""The progress at the mouse pointer, over all objects of one operator."""

from contextlib import contextmanager


@contextmanager
def shown(context, objects):
    """Yields a function that takes an object's number, from 0, and returns a function to tell its share, 0 to 1."""
    manager = context.window_manager
    manager.progress_begin(0, 100)
    last = [-1]

    def teller(number):
        def tell(share):
            percent = int(100 * (number + share) / objects)
            # The library tells more often than anyone can see.
            if percent != last[0]:
                last[0] = percent
                manager.progress_update(percent)

        return tell

    try:
        yield teller
    finally:
        manager.progress_end()
