//! What a file is, whatever its name, and what is said of one that a command does not take.

use std::path::PathBuf;

use super::common::{hssh, hssh_reading, root, scratch, text};

fn written(name: &str, bytes: &[u8]) -> String {
    let file: PathBuf = scratch("kinds").join(name);
    std::fs::write(&file, bytes).unwrap();
    file.to_string_lossy().into_owned()
}

/// The exit code, and everything that was said.
fn said(arguments: &[&str]) -> (Option<i32>, String) {
    let output = hssh(arguments);
    (output.status.code(), text(&output.stdout) + &text(&output.stderr))
}

#[test]
fn a_mark_or_another_encoding_changes_nothing() {
    let exploration = std::fs::read_to_string(root().join("fixtures/figure-2-4.ron")).unwrap();
    let graph = std::fs::read_to_string(root().join("fixtures/graphs/two-laps.g2o")).unwrap();
    let utf16 = |content: &str| -> Vec<u8> {
        [0xFEFF].into_iter().chain(content.encode_utf16()).flat_map(u16::to_le_bytes).collect()
    };
    let marked = |content: &str| format!("\u{feff}{content}").into_bytes();
    for (name, bytes) in [("a.txt", marked(&exploration)), ("b.log", utf16(&exploration))] {
        assert_eq!(said(&["check", &written(name, &bytes)]).0, Some(0), "{name}");
    }
    for (name, bytes) in
        [("a.ron", marked(&graph)), ("b.ron", utf16(&graph)), ("c", graph.replace('\n', "\r").into_bytes())]
    {
        let (code, said) = said(&["graph", &written(name, &bytes)]);
        assert!(code == Some(0) && said.contains("33 poses, 37 edges"), "{name}: {said}");
    }
}

#[test]
fn what_another_command_takes_is_told() {
    let log = "FLASER 3 1 1 1 0 0 0 0 0 0 0.5 host 0.5\n";
    let cases: [(&str, &[u8], &str, &str); 10] = [
        ("map", b"VERTEX_SE2 0 0 0 0\n", "a pose graph (its first record is `VERTEX_SE2`)", "`hssh graph`"),
        ("check", log.as_bytes(), "a laser log (its first message is `FLASER`)", "`hssh map`"),
        ("graph", log.as_bytes(), "a laser log", "`hssh map`"),
        ("graph", b"Exploration(stars: {})", "an exploration", "`hssh map`"),
        ("explore", b"(stars: {})", "an exploration", "`hssh map`"),
        ("stars", b"(stars: {})", "an exploration", "`hssh map`"),
        ("map", b"image: a.pgm\nresolution: 1\n", "the description of a grid map", "`hssh stars`"),
        ("map", b"{\n  \"format\": \"hssh-answer\",", "what hssh wrote (hssh-answer)", ""),
        ("check", &[0; 5000], "binary data", ""),
        (
            "map",
            b"version https://git-lfs.github.com/spec/v1\noid sha256:0\n",
            "a pointer of Git LFS",
            "`git lfs pull`",
        ),
    ];
    for (command, bytes, is, advice) in cases {
        let (code, said) = said(&[command, &written("some.file", bytes)]);
        assert_eq!(code, Some(2), "{command}: {said}");
        assert!(
            said.contains(is) && said.contains(advice) && said.contains("some.file"),
            "{command}: {said}"
        );
    }
}

#[test]
fn compressed_by_other_means_says_how_to_unpack() {
    for (bytes, unpacker) in [
        (&b"\x28\xB5\x2F\xFD\0\0"[..], "zstd -dc"),
        (b"\xFD7zXZ\0\0", "xz -dc"),
        (b"BZh91AY&SY", "bzip2 -dc"),
        (b"PK\x03\x04..", "unzip -p"),
    ] {
        for command in ["map", "graph", "explore", "check", "stars"] {
            let (code, said) = said(&[command, &written("packed", bytes)]);
            assert!(code == Some(2) && said.contains(unpacker), "{command}: {said}");
        }
    }
}

#[test]
fn standard_input_may_be_anything_that_a_file_may_be() {
    let log = written("empty.log", b"ODOM 0 0 0 0 0 0 0 h 0\n");
    let output = hssh_reading(&log, &["map", "-"]);
    assert!(text(&output.stderr).contains("no usable laser scan"), "{}", text(&output.stderr));
}

/// Nobody waits for the end of what has none, and nobody reads it on a terminal.
#[test]
fn endless_words_are_not_repeated() {
    let zeros = written("zeros", &vec![0; 5 << 20]);
    let word = written("word", &vec![b'z'; 5 << 20]);
    for command in ["map", "check", "graph", "explore", "stars"] {
        for file in [&zeros, &word] {
            let (code, said) = said(&[command, file]);
            assert!(code == Some(2) && said.len() < 2000, "{command}: {}", said.len());
        }
    }
}
