//! The arguments of `mediant completions` and `mediant man`.

use clap::Args;
use clap_complete::Shell;

#[derive(Args, Debug)]
#[command(
    after_help = "Example:\n  mediant completions bash > ~/.local/share/bash-completion/completions/mediant"
)]
pub(crate) struct CompletionsArgs {
    /// The shell
    #[arg(value_enum)]
    pub(crate) shell: Shell,
}

#[derive(Args, Debug)]
#[command(after_help = "Example:\n  mediant man run > mediant-run.1")]
pub(crate) struct ManArgs {
    /// The command; without it the page is that of the program
    pub(crate) command: Option<String>,
}
