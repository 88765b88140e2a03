//! The committed header is the one that cbindgen makes of the sources. `CROSSGUARD_BLESS=1` writes
//! it.

use std::path::Path;

#[test]
fn the_header_is_current() {
    let crate_folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let config = cbindgen::Config::from_file(crate_folder.join("cbindgen.toml")).unwrap();
    let mut generated = Vec::new();
    cbindgen::Builder::new()
        .with_config(config)
        .with_src(crate_folder.join("src/codes.rs"))
        .with_src(crate_folder.join("src/codes/generated.rs"))
        .with_src(crate_folder.join("src/abi.rs"))
        .with_src(crate_folder.join("src/ffi.rs"))
        .generate()
        .unwrap()
        .write(&mut generated);
    let generated = String::from_utf8(generated).unwrap() + &layout();
    let path = crate_folder.join("include/crossguard.h");
    if std::env::var_os("CROSSGUARD_BLESS").is_some() {
        std::fs::write(&path, &generated).unwrap();
    }
    let committed = std::fs::read_to_string(&path).unwrap();
    assert!(
        committed == generated,
        "include/crossguard.h is not what cbindgen makes of src; run: cargo xtask bless crossguard.h"
    );
}

/// The sizes of all structs, for the compiler of the caller to assert.
fn layout() -> String {
    macro_rules! sizes {
        ($($name:ident)*) => {
            [$((stringify!($name), size_of::<crossguard::$name>())),*]
        };
    }
    let sizes = sizes!(CrossguardRobot CrossguardSession CrossguardSettings CrossguardConfig
        CrossguardBody CrossguardTaskParameters CrossguardEvent CrossguardOutput CrossguardHeard
        CrossguardFollower CrossguardView);
    let asserted = sizes.map(|(name, size)| format!("CROSSGUARD_ASSERT_LEN({name}, {size});\n"));
    let guard = "#if UINTPTR_MAX == UINT64_MAX\nCROSSGUARD_ASSERT_LEN(CrossguardTurn, ";
    let turn = size_of::<crossguard::CrossguardTurn>();
    format!("{}{guard}{turn});\n#endif\n", asserted.concat())
}
