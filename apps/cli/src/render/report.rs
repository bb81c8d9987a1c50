//! What became of each model, for programs and for people.

use super::names::Job;
use crate::failure::Failure;
use crate::output::Output;
use crate::values::Size;
use serde::Serialize;
use std::path::Path;
use std::time::Duration;

/// What became of one model.
#[derive(Debug)]
pub(crate) enum Outcome {
    Drawn {
        notes: Vec<String>,
        time: Duration,
    },
    /// Its picture was there.
    Skipped,
    Failed(Failure),
}

#[derive(Debug, Serialize)]
pub(crate) struct Report {
    /// The program that wrote it.
    pineda: &'static str,
    drawn: usize,
    skipped: usize,
    failed: usize,
    models: Vec<Entry>,
}

#[derive(Debug, Serialize)]
struct Entry {
    /// `null` for the demo scene.
    input: Option<String>,
    output: Option<String>,
    status: &'static str,
    /// Width and height of a picture that was written.
    #[serde(skip_serializing_if = "Option::is_none")]
    size: Option<[u32; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    seconds: Option<f64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    notes: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<Problem>,
}

#[derive(Debug, Serialize)]
struct Problem {
    message: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    place: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    help: Option<String>,
}

impl Report {
    pub(crate) fn new(jobs: &[Job], outcomes: &[Outcome], size: Size) -> Self {
        let count = |is: fn(&Outcome) -> bool| outcomes.iter().filter(|outcome| is(outcome)).count();
        Self {
            pineda: env!("CARGO_PKG_VERSION"),
            drawn: count(|outcome| matches!(outcome, Outcome::Drawn { .. })),
            skipped: count(|outcome| matches!(outcome, Outcome::Skipped)),
            failed: count(|outcome| matches!(outcome, Outcome::Failed(_))),
            models: jobs.iter().zip(outcomes).map(|(job, outcome)| entry(job, outcome, size)).collect(),
        }
    }

    /// JSON in lines, with one at the end.
    pub(crate) fn json(&self) -> Result<String, Failure> {
        let text = serde_json::to_string_pretty(self);
        text.map(|text| text + "\n").map_err(|error| Failure::data(format_args!("no report could be made: {error}")))
    }
}

fn entry(job: &Job, outcome: &Outcome, size: Size) -> Entry {
    let text = |path: &Path| path.to_string_lossy().into_owned();
    let entry = Entry {
        input: job.model.as_deref().map(text),
        output: match &job.output {
            Output::File(path) => Some(text(path)),
            Output::Standard => None,
        },
        status: "",
        size: None,
        seconds: None,
        notes: Vec::new(),
        error: None,
    };
    match outcome {
        Outcome::Drawn { notes, time } => Entry {
            status: "drawn",
            size: Some([size.width, size.height]),
            // To the millisecond: more would be noise.
            seconds: Some((time.as_secs_f64() * 1e3).round() / 1e3),
            notes: notes.clone(),
            ..entry
        },
        Outcome::Skipped => Entry { status: "skipped", ..entry },
        Outcome::Failed(failure) => {
            let [message, place, help] = failure.parts().map(|part| part.map(str::to_owned));
            let message = message.unwrap_or_default();
            Entry { status: "failed", error: Some(Problem { message, place, help }), ..entry }
        }
    }
}
