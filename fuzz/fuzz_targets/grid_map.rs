//! Any bytes: reading the YAML file of a grid map and its image does not panic, and a lattice that is read has its cells.

#![no_main]

use hssh_local::read_map;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    // What comes before the first zero byte is the description, the rest the image.
    let end = bytes.iter().position(|&byte| byte == 0).unwrap_or(bytes.len());
    let folder = std::env::temp_dir().join(format!("hssh-fuzz-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("the folder of temporary files is writable");
    let image = bytes.get(end + 1..).unwrap_or_default();
    let yaml = folder.join("map.yaml");
    let text = [b"image: map.img\n", &bytes[..end]].concat();
    let written = std::fs::write(&yaml, text);
    written.and(std::fs::write(folder.join("map.img"), image)).expect("its files are writable");
    if let Ok(grid) = read_map(&yaml) {
        assert_eq!(grid.cells().len(), grid.lattice().len());
    }
});
