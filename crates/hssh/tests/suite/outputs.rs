//! Where results go: never over what was read, never two into one file, and never nowhere.

use std::path::PathBuf;

use super::common::{hssh, root, scratch, text};

/// A copy of an exploration in a folder of its own.
fn exploration(name: &str) -> (PathBuf, PathBuf) {
    let folder = scratch(&format!("outputs-{name}"));
    let file = folder.join("in.ron");
    std::fs::copy(root().join("fixtures/aces.ron"), &file).unwrap();
    (folder, file)
}

#[test]
fn no_output_goes_over_the_input() {
    let (folder, file) = exploration("over");
    let before = std::fs::read(&file).unwrap();
    let input = file.to_str().unwrap();
    let mut names = vec![file.clone(), folder.join("../outputs-over/./in.ron")];
    for link in ["soft", "hard"].map(|link| folder.join(link)) {
        let _ = std::fs::remove_file(&link);
        match link.ends_with("soft") {
            #[cfg(unix)]
            true => std::os::unix::fs::symlink(&file, &link).unwrap(),
            _ => std::fs::hard_link(&file, &link).unwrap(),
        }
        names.push(link);
    }
    for name in names {
        for flag in ["--svg", "--dot", "--g2o", "--tree", "--certificate"] {
            let output = hssh(&["map", input, "--planar", flag, name.to_str().unwrap()]);
            assert_eq!(output.status.code(), Some(2), "{flag} {}", name.display());
            assert!(output.stdout.is_empty() && text(&output.stderr).contains("is the input"));
        }
        let output = hssh(&["check", input, "--dot", name.to_str().unwrap()]);
        assert_eq!(output.status.code(), Some(2));
    }
    assert_eq!(std::fs::read(&file).unwrap(), before);
}

#[test]
fn two_outputs_are_two_files() {
    let (folder, file) = exploration("two");
    let x = folder.join("x");
    let also_x = folder.join("../outputs-two/x");
    let output = hssh(&[
        "map",
        file.to_str().unwrap(),
        "--svg",
        x.to_str().unwrap(),
        "--dot",
        also_x.to_str().unwrap(),
    ]);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("one file"));
    let log = folder.join("s.log").to_string_lossy().into_owned();
    assert_eq!(hssh(&["simulate", "--floor", "ring", "-o", &log, "--truth", &log]).status.code(), Some(2));
    assert!(!x.exists() && !folder.join("s.log").exists());
}

/// What cannot be written is known before the work is done.
#[test]
fn outputs_are_tried_first() {
    let (folder, file) = exploration("first");
    let input = file.to_str().unwrap();
    for out in [folder.join("none/x.svg"), folder.clone()] {
        let out = out.to_str().unwrap();
        for arguments in [
            &["map", input, "--planar", "--svg", out][..],
            &["simulate", "--floor", "ring", "-o", out],
            &["graph", "fixtures/graphs/two-laps.g2o", "--g2o", out],
            &["stars", "fixtures/grids/floor.yaml", "--svg", out],
        ] {
            let output = hssh(arguments);
            assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0), "{arguments:?}");
            assert!(text(&output.stderr).starts_with("error: cannot write"), "{arguments:?}");
        }
    }
    let left: Vec<_> = std::fs::read_dir(&folder).unwrap().collect();
    assert_eq!(left.len(), 1, "trying leaves nothing behind: {left:?}");
}

/// What fails in the end loses neither the report nor the other files.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_loses_only_what_was_to_go_there() {
    let (folder, file) = exploration("full");
    let g2o = folder.join("good.g2o");
    let _ = std::fs::remove_file(&g2o);
    let output = hssh(&[
        "map",
        file.to_str().unwrap(),
        "--planar",
        "--svg",
        "/dev/full",
        "--g2o",
        g2o.to_str().unwrap(),
    ]);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stdout).contains("One map is the most probable"));
    assert!(text(&output.stderr).contains("cannot write /dev/full") && g2o.exists());
    let output = hssh(&["stars", "fixtures/grids/floor.yaml", "--svg", "/dev/full"]);
    assert!(output.status.code() == Some(2) && !output.stdout.is_empty());
}

/// A file is replaced as a whole and keeps its permissions; a link stays a link.
#[cfg(unix)]
#[test]
fn a_file_is_replaced_behind_its_link() {
    use std::os::unix::fs::PermissionsExt;
    let (folder, file) = exploration("link");
    let (real, link) = (folder.join("real.svg"), folder.join("link.svg"));
    std::fs::write(&real, "old").unwrap();
    std::fs::set_permissions(&real, std::fs::Permissions::from_mode(0o640)).unwrap();
    let _ = std::fs::remove_file(&link);
    std::os::unix::fs::symlink(&real, &link).unwrap();
    let output = hssh(&["map", file.to_str().unwrap(), "--planar", "--svg", link.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(0));
    assert!(std::fs::read_to_string(&real).unwrap().starts_with("<svg"));
    assert!(std::fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(std::fs::metadata(&real).unwrap().permissions().mode() & 0o777, 0o640);
}

/// A rank that cannot be is refused before anything is searched; one that is not there, before the answer, which is
/// printed all the same.
#[test]
fn a_rank_that_is_not_there_is_refused() {
    let (folder, file) = exploration("rank");
    let (input, svg) = (file.to_str().unwrap(), folder.join("out.svg"));
    let out = svg.to_str().unwrap();
    let output = hssh(&["map", input, "--planar", "--rank", "11", "--svg", out]);
    assert_eq!(output.status.code(), Some(2));
    assert!(output.stdout.is_empty() && text(&output.stderr).contains("add --top 11"));
    let output = hssh(&["map", input, "--planar", "--rank", "5000", "--all", "--svg", out]);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("there is no map number 5000"));
    assert!(text(&output.stdout).contains("rank") && !svg.exists());
}
