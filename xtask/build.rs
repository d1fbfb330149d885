//! Does nothing: only with a build script do build dependencies count, and the features that they ask for.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
}
