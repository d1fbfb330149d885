//! The layers: which crate may use which, in one table, checked against `cargo metadata`.

use std::error::Error;
use std::process::Command;

use serde::Deserialize;

use crate::root;

/// Every crate with the crates of the workspace that it may use, in dependency order.
///
/// The layers follow the SSH: control and causal below topological, metrical beside it, search above.
/// Dev-dependencies are free; `hssh-oracle` may be nothing else.
const LAYERS: [(&str, &[&str]); 14] = [
    ("hssh-topology", &[]),
    ("hssh-causal", &["hssh-topology"]),
    ("hssh-verify", &["hssh-causal", "hssh-topology"]),
    ("hssh-metrics", &[]),
    ("hssh-local", &["hssh-causal", "hssh-topology", "hssh-metrics"]),
    ("hssh-io", &["hssh-metrics", "hssh-local"]),
    ("hssh-search", &["hssh-causal", "hssh-topology", "hssh-metrics"]),
    ("hssh-cluster", &["hssh-causal", "hssh-search"]),
    ("hssh-world", &["hssh-causal", "hssh-topology", "hssh-metrics", "hssh-local"]),
    ("hssh-draw", &["hssh-topology", "hssh-metrics", "hssh-local", "hssh-search"]),
    ("hssh-oracle", &["hssh-causal", "hssh-topology"]),
    (
        "hssh",
        &[
            "hssh-topology",
            "hssh-causal",
            "hssh-verify",
            "hssh-metrics",
            "hssh-local",
            "hssh-io",
            "hssh-search",
            "hssh-cluster",
            "hssh-world",
            "hssh-draw",
        ],
    ),
    (
        "hssh-experiments",
        &[
            "hssh-topology",
            "hssh-causal",
            "hssh-verify",
            "hssh-metrics",
            "hssh-local",
            "hssh-io",
            "hssh-search",
            "hssh-world",
            "hssh-draw",
            "hssh",
        ],
    ),
    ("xtask", &[]),
];

/// What `cargo metadata` says of the workspace, as far as it matters here.
#[derive(Debug, Deserialize)]
struct Metadata {
    packages: Vec<Package>,
}

#[derive(Debug, Deserialize)]
struct Package {
    name: String,
    manifest_path: String,
    dependencies: Vec<Dependency>,
}

#[derive(Debug, Deserialize)]
struct Dependency {
    name: String,
    /// `dev`, `build`, or nothing.
    kind: Option<String>,
}

/// All arrows and orders that break the layers, as sentences.
pub(crate) fn violations() -> Result<Vec<String>, Box<dyn Error>> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(cargo)
        .args(["metadata", "--no-deps", "--format-version", "1"])
        .current_dir(root::root())
        .output()?;
    if !output.status.success() {
        return Err(format!("cargo metadata: {}", String::from_utf8_lossy(&output.stderr)).into());
    }
    let metadata: Metadata = serde_json::from_slice(&output.stdout)?;
    let manifest = std::fs::read_to_string(root::root().join("Cargo.toml"))?;
    Ok([wrong_arrows(&metadata.packages), wrong_order(&metadata.packages, &members(&manifest))].concat())
}

fn wrong_arrows(packages: &[Package]) -> Vec<String> {
    let mut wrong = Vec::new();
    for package in packages {
        let Some((_, allowed)) = LAYERS.iter().find(|(name, _)| *name == package.name) else {
            wrong.push(format!("{} has no layer: add it to xtask/src/layers.rs", package.name));
            continue;
        };
        for used in uses(package, packages).filter(|used| !allowed.contains(used)) {
            wrong.push(format!("{} uses {used}, which its layer may not", package.name));
        }
    }
    let is_there = |name: &str| packages.iter().any(|package| package.name == name);
    let gone = LAYERS.iter().filter(|(name, _)| !is_there(name));
    wrong.extend(gone.map(|(name, _)| format!("{name} has a layer but is no member of the workspace")));
    wrong
}

/// The crates of the workspace that a crate uses other than in its tests.
fn uses<'a>(package: &'a Package, packages: &'a [Package]) -> impl Iterator<Item = &'a str> {
    let normal = package.dependencies.iter().filter(|dependency| dependency.kind.as_deref() != Some("dev"));
    let names = normal.map(|dependency| dependency.name.as_str());
    names.filter(|name| packages.iter().any(|other| other.name == *name))
}

/// The folders that the manifest lists as members, in its order.
fn members(manifest: &str) -> Vec<&str> {
    let list = manifest.split_once("members = [").and_then(|(_, rest)| rest.split_once(']'));
    list.map_or_else(Vec::new, |(list, _)| list.split('"').skip(1).step_by(2).collect())
}

/// Members that the manifest lists before a crate they use.
fn wrong_order(packages: &[Package], members: &[&str]) -> Vec<String> {
    let position = |package: &Package| {
        members.iter().position(|member| package.manifest_path.ends_with(&format!("/{member}/Cargo.toml")))
    };
    let mut wrong = Vec::new();
    for package in packages {
        for used in uses(package, packages) {
            let used = packages.iter().find(|other| other.name == used);
            if used.is_some_and(|used| position(used) >= position(package)) {
                let used = used.map_or("", |used| &used.name);
                wrong.push(format!("Cargo.toml lists {} before {used}, which it uses", package.name));
            }
        }
    }
    wrong
}

#[cfg(test)]
mod tests {
    use super::*;

    fn package(name: &str, dependencies: &[(&str, Option<&str>)]) -> Package {
        let dependency = |&(name, kind): &(&str, Option<&str>)| Dependency {
            name: name.to_owned(),
            kind: kind.map(str::to_owned),
        };
        Package {
            name: name.to_owned(),
            manifest_path: format!("/repository/crates/{name}/Cargo.toml"),
            dependencies: dependencies.iter().map(dependency).collect(),
        }
    }

    #[test]
    fn every_crate_keeps_to_its_layer() {
        assert_eq!(violations().unwrap(), Vec::<String>::new());
    }

    #[test]
    fn an_arrow_upwards_is_found_and_one_in_tests_is_not() {
        let others = LAYERS.iter().filter(|(name, _)| *name != "hssh-topology" && *name != "hssh-causal");
        let mut packages: Vec<Package> = others.map(|(name, _)| package(name, &[])).collect();
        packages.push(package("hssh-topology", &[("hssh-search", None), ("hssh-oracle", Some("dev"))]));
        packages.push(package("hssh-causal", &[("hssh-oracle", None), ("serde", None)]));
        let wrong = wrong_arrows(&packages);
        assert_eq!(
            wrong,
            [
                "hssh-topology uses hssh-search, which its layer may not",
                "hssh-causal uses hssh-oracle, which its layer may not"
            ]
        );
    }

    #[test]
    fn the_manifest_lists_what_is_used_first() {
        let packages = [package("hssh-topology", &[]), package("hssh-causal", &[("hssh-topology", None)])];
        let right = "members = [\n \"crates/hssh-topology\",\n \"crates/hssh-causal\" ]";
        assert!(wrong_order(&packages, &members(right)).is_empty());
        let wrong = "members = [\"crates/hssh-causal\", \"crates/hssh-topology\"]";
        assert_eq!(
            wrong_order(&packages, &members(wrong)),
            ["Cargo.toml lists hssh-causal before hssh-topology, which it uses"]
        );
    }

    #[test]
    fn the_table_is_in_dependency_order() {
        for (position, (name, allowed)) in LAYERS.iter().enumerate() {
            let below = &LAYERS[..position];
            assert!(allowed.iter().all(|used| below.iter().any(|(name, _)| name == used)), "{name}");
        }
    }
}
