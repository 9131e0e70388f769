# SPDX-License-Identifier: GPL-3.0-or-later
"""What stops the work on one object for a reason that the user can do something about."""


class Refusal(Exception):
    """The text names the object and says what to do."""

    severity = "ERROR"


class NothingSelected(Refusal):
    """The user asked for the selection alone, and there is none."""

    severity = "WARNING"
