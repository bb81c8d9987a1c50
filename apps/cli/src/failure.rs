//! What went wrong, as a person at a terminal reads it.

use std::fmt;
use std::process::ExitCode;

/// An error message in one block: what, where, and what to do about it.
#[derive(Debug)]
pub(crate) struct Failure {
    kind: Kind,
    what: String,
    place: Option<String>,
    help: Option<String>,
}

#[derive(Clone, Copy, Debug)]
enum Kind {
    /// The command line asks for what cannot be: exit code 2, as clap's own.
    Usage,
    /// The command line is fine, but a file or the machine is not: exit code 1.
    Data,
}

impl Failure {
    /// The command line asks for what cannot be.
    pub(crate) fn usage(what: impl fmt::Display) -> Self {
        Self { kind: Kind::Usage, what: what.to_string(), place: None, help: None }
    }

    /// A file, or what it holds, or the machine is at fault.
    pub(crate) fn data(what: impl fmt::Display) -> Self {
        Self { kind: Kind::Data, what: what.to_string(), place: None, help: None }
    }

    /// In which file or argument.
    pub(crate) fn at(mut self, place: impl fmt::Display) -> Self {
        self.place = Some(place.to_string());
        self
    }

    /// In which file or argument, unless that is known already.
    pub(crate) fn at_first(self, place: impl fmt::Display) -> Self {
        if self.place.is_some() { self } else { self.at(place) }
    }

    /// What, where, and what to do about it.
    pub(crate) fn parts(&self) -> [Option<&str>; 3] {
        [Some(&self.what), self.place.as_deref(), self.help.as_deref()]
    }

    /// What to do about it.
    pub(crate) fn help(mut self, help: impl fmt::Display) -> Self {
        self.help = Some(help.to_string());
        self
    }

    pub(crate) fn exit_code(&self) -> ExitCode {
        ExitCode::from(match self.kind {
            Kind::Usage => 2,
            Kind::Data => 1,
        })
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "error: {}", self.what)?;
        for (name, text) in [("where", &self.place), ("help", &self.help)] {
            if let Some(text) = text {
                writeln!(f, "  {name}: {text}")?;
            }
        }
        Ok(())
    }
}

impl From<pineda::Error> for Failure {
    fn from(error: pineda::Error) -> Self {
        match error {
            pineda::Error::SimdUnavailable { .. } => Self::usage(error).at("--simd").help("--simd auto takes the best"),
            pineda::Error::TargetSize { .. } => Self::usage(error).at("the picture's size"),
            _ => Self::data(error),
        }
    }
}
