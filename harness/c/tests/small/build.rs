//! Tells the linker where the memory of the board is.

fn main() {
    let folder = env!("CARGO_MANIFEST_DIR");
    let architecture = std::env::var("CARGO_CFG_TARGET_ARCH").unwrap_or_default();
    println!("cargo::rerun-if-changed=sections.x");
    println!("cargo::rerun-if-changed={architecture}.x");
    println!("cargo::rustc-link-arg-bins=-L{folder}");
    println!("cargo::rustc-link-arg-bins=-T{architecture}.x");
}
