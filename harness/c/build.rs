//! Names the shared library by the version of its interface, so that a program finds one that fits.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=src/abi.rs");
    let abi = std::fs::read_to_string("src/abi.rs").unwrap_or_default();
    let version = abi
        .lines()
        .find_map(|line| line.strip_prefix("pub const CROSSGUARD_ABI_VERSION: u32 = "));
    let version = version.map(|version| version.trim_end_matches(';'));
    let is_elf = std::env::var("CARGO_CFG_TARGET_OS").is_ok_and(|os| os == "linux");
    if let (Some(version), true) = (version, is_elf) {
        println!("cargo::rustc-cdylib-link-arg=-Wl,-soname,libcrossguard.so.{version}");
    }
}
