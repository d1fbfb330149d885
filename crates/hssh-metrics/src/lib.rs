//! SE(2), pose graphs and least squares.
