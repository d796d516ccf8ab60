//! The native command `bindpose`: the core and the renderer for a terminal.
//!
//! Results go to standard output and failures to standard error. The exit code is 0 when all is well, 1 when a file has
//! errors, 2 for wrong use, an unreadable file or a missing GPU; the worst of several files counts.

mod appearance;
mod check;
mod codes;
mod convert;
mod diagnostic;
mod failure;
#[doc(hidden)]
pub mod for_tests;
mod in_order;
mod info;
mod input;
mod output;
mod paths;
mod pose;
mod progress;
mod quiet;
mod render;
mod series;
mod text;
mod textures;

use std::io::{self, BufWriter, Write};
use std::process::ExitCode;

use clap::{Parser, Subcommand};

use failure::{Failure, Outcome};
use output::UntilClosed;

/// Looks at skinned models: .m3d, the text format of Frank Luna's DirectX books, glTF and FBX.
#[derive(Debug, Parser)]
#[command(name = "bindpose", version, after_help = EXIT_CODES)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

const EXIT_CODES: &str = "\
Exit codes:
  0  all is well
  1  a file has errors
  2  wrong use, or something is missing: a file that can be read, a clip, a GPU";

#[derive(Debug, Subcommand)]
enum Command {
    Info(info::Arguments),
    Check(check::Arguments),
    Pose(pose::Arguments),
    Render(Box<render::Arguments>),
    Convert(Box<convert::Arguments>),
}

/// Runs the command with the arguments of this process.
pub fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => {
            // Help goes to standard output with code 0, wrong use to standard error with code 2. A closed stream is ignored.
            let _ = error.print();
            return u8::try_from(error.exit_code()).map_or(Outcome::Failed.into(), ExitCode::from);
        }
    };
    let mut out = BufWriter::new(UntilClosed::new(io::stdout().lock()));
    let mut err = io::stderr().lock();
    let outcome = run(&arguments.command, &mut out, &mut err).and_then(|outcome| {
        out.flush()?;
        Ok(outcome)
    });
    let outcome = outcome.unwrap_or_else(|failure| {
        // The output before the failure is shown first. A second failure is ignored.
        let _ = out.flush();
        failure.report(&mut err)
    });
    outcome.into()
}

fn run(command: &Command, out: &mut dyn Write, err: &mut dyn Write) -> Result<Outcome, Failure> {
    match command {
        Command::Info(arguments) => info::run(arguments, out, err)?,
        Command::Check(arguments) => return check::run(arguments, out, err),
        Command::Pose(arguments) => pose::run(arguments, out)?,
        Command::Render(arguments) => return render::run(arguments, out, err),
        Command::Convert(arguments) => return convert::run(arguments, out, err),
    }
    Ok(Outcome::Fine)
}
