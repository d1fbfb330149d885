//! Any bytes: what a file is can be said in one short line.

#![no_main]

use hssh::kind::FileKind;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let kind = FileKind::of(bytes);
    assert_eq!(kind == FileKind::Empty, bytes.is_empty());
    assert!(!kind.to_string().contains('\n'));
});
