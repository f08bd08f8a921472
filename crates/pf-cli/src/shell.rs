//! `pf completions` and `pf man`: what a shell and a reader of manuals want to know of the program.

use crate::failure::{Failure, Status};
use clap::Command;
use clap_complete::{Shell, generate};
use clap_mangen::Man;
use pf_io::{make_folder, write_whole};
use std::{
    io::{Write, stdout},
    path::PathBuf,
};

/// Print what a shell needs to complete the program's arguments
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  pf completions bash > ~/.local/share/bash-completion/completions/pf
  pf completions zsh > ~/.zfunc/_pf
  pf completions fish > ~/.config/fish/completions/pf.fish")]
pub(crate) struct CompletionsArgs {
    /// For which shell
    shell: Shell,
}

pub(crate) fn completions(args: &CompletionsArgs, mut program: Command) -> Result<Status, Failure> {
    let mut text = Vec::new();
    generate(args.shell, &mut program, "pf", &mut text);
    stdout().lock().write_all(&text)?;
    Ok(Status::Done)
}

/// Write manual pages, one for the program and one for each verb
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  pf man ~/.local/share/man/man1 && man pf-plan")]
pub(crate) struct ManArgs {
    /// Into which folder
    folder: PathBuf,
}

pub(crate) fn man(args: &ManArgs, mut program: Command) -> Result<Status, Failure> {
    make_folder(&args.folder).map_err(|error| Failure::unwritten(&error))?;
    // Gives verbs their names in full: `pf-plan`, and `pf plan` in the synopsis.
    program.build();
    let verbs = program
        .get_subcommands()
        .filter(|verb| verb.get_name() != "help");
    let mut out = stdout().lock();
    for page in std::iter::once(&program).chain(verbs) {
        let name = page.get_display_name().unwrap_or("pf").to_owned();
        let file = args.folder.join(format!("{name}.1"));
        let page = Man::new(page.clone()).title(name);
        write_whole(&file, |to| page.render(to)).map_err(|error| Failure::unwritten(&error))?;
        writeln!(out, "{}", file.display())?;
    }
    Ok(Status::Done)
}
