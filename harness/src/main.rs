//! The `crossguard` command.

fn main() -> std::process::ExitCode {
    crossguard_harness::cli::main()
}
