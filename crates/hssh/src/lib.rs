//! The hybrid spatial semantic hierarchy: the library of everything, and the program.
