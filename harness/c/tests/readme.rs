//! The C++ in the README and the C on the front page of the documentation compile, with stand-ins for what a robot
//! brings along. The examples are a whole crossing.

use std::path::Path;
use std::process::Command;

use crossguard_testkit::c::{Language, compile, compile_to_object};

/// The first block of code in this language.
fn block(page: &str, language: &str) -> String {
    let start = format!("```{language}\n");
    let (_, block) = page.split_once(&start).expect("a block of code");
    block.split_once("```").expect("it ends").0.to_owned()
}

fn assert_compiles(language: Language, file: &str, code: &str) {
    let source = Path::new(env!("CARGO_TARGET_TMPDIR")).join(file);
    std::fs::write(&source, code).unwrap();
    compile_to_object(file, language, &source);
}

#[test]
fn the_readmes_robot_compiles() {
    let code = block(include_str!("../README.md"), "cpp");
    let code = format!("{}\n{code}", include_str!("readme.hpp"));
    assert_compiles(Language::Cpp, "readme.cpp", &code);
}

#[test]
fn the_robot_of_the_front_page_compiles() {
    let page = include_str!("../src/lib.rs").replace("\n//! ", "\n");
    let code = format!(
        "#include <crossguard.h>\n#include <stddef.h>\n\
         void carry_out(const CrossguardOutput *output, const uint8_t *packets);\n\
         int step(uint16_t boot, uint32_t elapsed_ms);\n\
         int step(uint16_t boot, uint32_t elapsed_ms) {{\n{}return 0;\n}}\n",
        block(&page, "c")
    );
    assert_compiles(Language::C, "front_page.c", &code);
}

#[test]
fn a_whole_crossing_fits_in_sixty_lines() {
    for (language, file) in [
        (Language::C, "examples/crossing.c"),
        (Language::Cpp, "examples/crossing.cpp"),
    ] {
        let code = std::fs::read_to_string(file).unwrap();
        assert!(code.lines().count() <= 60, "{file}");
        if let Some(program) = compile("a_whole_crossing", language, file) {
            assert!(Command::new(program).status().unwrap().success(), "{file}");
        }
    }
}
