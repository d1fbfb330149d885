//! Maps and search trees as SVG and DOT.
