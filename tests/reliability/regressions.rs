//! What fuzzing has found, as it was found.
