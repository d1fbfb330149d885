//! Every file in `fixtures/malformed` is refused, with a message that says where and what to do.

use std::path::{Path, PathBuf};

use hssh_causal::Exploration;

fn malformed_files() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/malformed");
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .expect("the fixtures exist")
        .map(|entry| entry.expect("a folder can be listed").path())
        .collect();
    files.sort();
    files
}

#[test]
fn messages_are_as_reviewed() {
    let files = malformed_files();
    assert!(files.len() >= 45, "the fixtures are missing");
    for file in files {
        let bytes = std::fs::read(&file).unwrap();
        let error = Exploration::from_ron_bytes(&bytes).expect_err(&file.display().to_string());
        let file_name = file.file_name().unwrap().to_str().unwrap();
        let rendered = error.render(file_name, &String::from_utf8_lossy(&bytes));
        let name = file.file_stem().unwrap().to_str().unwrap();
        insta::with_settings!({ omit_expression => true, prepend_module_to_snapshot => false }, {
            insta::assert_snapshot!(name, rendered);
        });
    }
}
