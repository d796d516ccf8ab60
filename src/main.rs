//! The native command `bindpose`: everything is in the library's `cli`.

use std::process::ExitCode;

fn main() -> ExitCode {
    bindpose::cli::main()
}
