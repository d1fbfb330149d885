//! What can go wrong with a map's files.

use std::path::{Path, PathBuf};

use crate::grid::LatticeError;

/// Why a map could not be read or written; each says in which file.
#[derive(Debug, thiserror::Error)]
pub enum MapError {
    /// The file system refused.
    #[error("cannot {verb} {}: {source}", .file.display())]
    Io {
        /// "read" or "write".
        verb: &'static str,
        /// The file.
        file: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// The YAML file names an image that is not there.
    #[error("{} names the image {}, which cannot be read: {source}", .yaml.display(), .image.display())]
    NoImage {
        /// The YAML file.
        yaml: PathBuf,
        /// The image it names, found relative to it.
        image: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// The YAML file is not as `map_server` wants it.
    #[error("{}: {problem}", .file.display())]
    Yaml {
        /// The YAML file.
        file: PathBuf,
        /// What is wrong, with line and column.
        problem: String,
    },
    /// The YAML file can be read, but says something impossible or unsupported.
    #[error("{}: {problem}", .file.display())]
    Description {
        /// The YAML file.
        file: PathBuf,
        /// What is wrong, and what to do.
        problem: String,
    },
    /// The image cannot be decoded.
    #[error("{}: no readable image, PGM (P2, P5), PNG, BMP, JPEG, TIFF or WebP: {problem}", .file.display())]
    Image {
        /// The image.
        file: PathBuf,
        /// What is wrong with it.
        problem: String,
    },
    /// The image makes no lattice.
    #[error("{}: {source}", .file.display())]
    Lattice {
        /// The image.
        file: PathBuf,
        /// Why.
        source: LatticeError,
    },
}

impl MapError {
    pub(super) fn io(verb: &'static str, file: &Path) -> impl FnOnce(std::io::Error) -> Self {
        move |source| MapError::Io { verb, file: file.to_owned(), source }
    }

    pub(super) fn image(file: &Path) -> impl FnOnce(String) -> Self {
        move |problem| MapError::Image { file: file.to_owned(), problem }
    }

    pub(super) fn lattice(file: &Path) -> impl FnOnce(LatticeError) -> Self {
        move |source| MapError::Lattice { file: file.to_owned(), source }
    }
}
