//! `mediant completions` and `mediant man`: what shells and `man` read, made from the arguments.

use std::io::Write;

use clap::CommandFactory;
use clap_mangen::Man;

use crate::{
    args::{Cli, CompletionsArgs, ManArgs},
    failure::Failure,
    terminal::screen::Screen,
};

/// Prints what a shell completes.
pub(crate) fn completions(args: &CompletionsArgs, screen: &mut Screen) -> Result<(), Failure> {
    // The generator panics if its writer fails, so that it writes to memory.
    let mut text = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "mediant", &mut text);
    Ok(screen.write_all(&text)?)
}

/// Prints the manual page of the program or of a command.
pub(crate) fn man(args: &ManArgs, screen: &mut Screen) -> Result<(), Failure> {
    let mut program = Cli::command();
    program.build();
    let page = match &args.command {
        None => Man::new(program),
        Some(name) => {
            let command = program.find_subcommand(name).cloned().ok_or_else(|| {
                let known: Vec<&str> = program.get_subcommands().map(clap::Command::get_name).collect();
                Failure::NoCommand { name: name.clone(), known: known.join(", ") }
            })?;
            // A page has the name of its file: mediant-run(1).
            Man::new(command).title(format!("mediant-{name}"))
        }
    };
    Ok(page.render(screen)?)
}
