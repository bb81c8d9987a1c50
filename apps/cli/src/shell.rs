//! What makes a command at home in a shell: completions, and pages for `man`.

use crate::arguments::Arguments;
use crate::failure::Failure;
use clap::CommandFactory;
use clap_complete::Shell;
use std::io::Write;

/// Prints a completion script.
pub(crate) fn completions(shell: Shell) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Arguments::command(), "pineda", &mut script);
    print(&script)
}

/// Prints the page of pineda, or of a command.
pub(crate) fn man(command: Option<&str>) -> Result<(), Failure> {
    let mut all = Arguments::command();
    // Global options appear in the commands' pages, too.
    all.build();
    let page = match command {
        None => all,
        Some(name) => {
            let names: Vec<String> = all.get_subcommands().map(|command| command.get_name().to_owned()).collect();
            let found = all.find_subcommand(name).cloned().ok_or_else(|| {
                Failure::usage(format_args!("there is no command {name}"))
                    .help(format_args!("the commands are {}", names.join(", ")))
            })?;
            // As the page is called: pineda-render.
            let title = found.get_display_name().unwrap_or(name).to_owned();
            found.display_name(title)
        }
    };
    let mut text = Vec::new();
    let made = clap_mangen::Man::new(page).render(&mut text);
    made.map_err(|error| Failure::data(format_args!("the page could not be made: {error}")))?;
    print(&text)
}

fn print(bytes: &[u8]) -> Result<(), Failure> {
    match std::io::stdout().write_all(bytes) {
        // `pineda man | head`.
        Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
        result => result.map_err(|error| Failure::data(format_args!("standard output cannot be written: {error}"))),
    }
}
