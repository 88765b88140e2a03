//! What a robot stack that embeds the endpoint has to build: without messages of other stations and without security
//! it is little.

use std::collections::BTreeSet;
use std::process::Command;

/// How many packages there may be, those of the kit included.
const PACKAGES_MAX: usize = 40;

#[test]
fn without_foreign_messages_and_security_there_are_few_packages() {
    let listed = Command::new(env!("CARGO"))
        .args(["tree", "--offline", "--package", "crossguard-endpoint"])
        .args(["--edges", "normal", "--prefix", "none"])
        .args(["--no-default-features", "--features", "std"])
        .env_remove("CARGO_RESOLVER_FEATURE_UNIFICATION")
        .output()
        .unwrap();
    assert!(listed.status.success(), "{listed:?}");
    let listed = String::from_utf8(listed.stdout).unwrap();
    let packages = listed.lines().filter_map(|line| line.split(' ').next());
    let packages: BTreeSet<_> = packages.filter(|name| !name.is_empty()).collect();
    println!("{} packages: {packages:?}", packages.len());
    assert!(packages.contains("crossguard-protocol"));
    for heavy in ["rasn", "p256", "ring"] {
        assert!(!packages.contains(heavy), "{packages:?}");
    }
    assert!(packages.len() <= PACKAGES_MAX, "{packages:?}");
}
