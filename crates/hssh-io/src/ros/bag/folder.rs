//! A folder as a bag: the files that its `metadata.yaml` lists, or all bags in it.

use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::BagError;

/// What is needed of `metadata.yaml`; versions of the format differ in the rest.
#[derive(Deserialize)]
struct Metadata {
    rosbag2_bagfile_information: Information,
}

#[derive(Deserialize)]
struct Information {
    #[serde(default)]
    relative_file_paths: Vec<String>,
}

/// The files of a bag, in order.
pub(super) fn files(folder: &Path) -> Result<Vec<PathBuf>, BagError> {
    let listed = listed(folder)?;
    if !listed.is_empty() {
        return Ok(listed);
    }
    let entries = std::fs::read_dir(folder).map_err(BagError::read(folder))?;
    let mut found: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    found.retain(|file| {
        let name = file.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
        let name = name.strip_suffix(".zstd").unwrap_or(&name);
        [".mcap", ".db3", ".bag"].iter().any(|ending| name.ends_with(ending))
    });
    // Splits are numbered; `bag_10` comes behind `bag_9`.
    found.sort_by_key(|file| (number(file), file.clone()));
    if found.is_empty() {
        let reason =
            "the folder has neither a metadata.yaml that lists files nor any .mcap, .db3 or .bag file";
        return Err(BagError::NoBag { file: folder.to_owned(), reason: reason.to_owned() });
    }
    Ok(found)
}

fn listed(folder: &Path) -> Result<Vec<PathBuf>, BagError> {
    let file = folder.join("metadata.yaml");
    let Ok(text) = std::fs::read_to_string(&file) else { return Ok(Vec::new()) };
    // A damaged list is no reason to refuse files that are there.
    let Ok(metadata) = serde_saphyr::from_str::<Metadata>(&text) else { return Ok(Vec::new()) };
    let names = metadata.rosbag2_bagfile_information.relative_file_paths;
    let present = |name: String| {
        // Early versions write the folder's own name before that of the file.
        let plain = Path::new(&name).file_name().map(|last| folder.join(last));
        let unpacked = name.strip_suffix(".zstd").map(|name| folder.join(name));
        let candidates =
            [Some(folder.join(&name)), plain, unpacked, Some(folder.join(format!("{name}.zstd")))];
        let found = candidates.into_iter().flatten().find(|file| file.is_file());
        found.ok_or_else(|| {
            let error = std::io::Error::new(
                std::io::ErrorKind::NotFound,
                "metadata.yaml lists it, but it is not there",
            );
            BagError::Read { file: folder.join(&name), error }
        })
    };
    names.into_iter().map(present).collect()
}

/// The last number in the name of a file.
fn number(file: &Path) -> u64 {
    let stem = file.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
    let stem = stem.split('.').next().unwrap_or_default();
    let digits = stem.rsplit(|c: char| !c.is_ascii_digit()).next().unwrap_or_default();
    digits.parse().unwrap_or(0)
}
