//! Writes the sample to `web/sample`.

use std::process::ExitCode;

fn main() -> ExitCode {
    for (name, bytes) in sample_figure::files() {
        let path = sample_figure::folder().join(name);
        if let Err(error) = std::fs::write(&path, &bytes) {
            eprintln!("{}: {error}", path.display());
            return ExitCode::FAILURE;
        }
        eprintln!("{name}: {} bytes", bytes.len());
    }
    ExitCode::SUCCESS
}
