//! The command where the machine lets it down.
