//! The same judgements with JSON in and out, for hosts of other languages.
//!
//! What goes in are [`Headers`] and [`Wanted`]; what comes out is one object, `{"plan": …}` with a [`Plan`],
//! `{"series": […]}` with [`Report`]s, or `{"error": …}` with an [`Error`].

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::error::{Error, Result};
use crate::headers::Headers;
use crate::judging::{self, Wanted};
use crate::plan::Plan;
use crate::report::Report;

#[derive(Serialize)]
#[serde(rename_all = "snake_case")]
enum Answer {
    Plan(Plan),
    Series(Vec<Report>),
    Error(Error),
}

/// How images become one volume, or why they do not.
pub fn judge(headers: &[u8], wanted: &[u8]) -> String {
    let judged = || judging::judge(&read::<Headers>(headers, "headers")?, &read::<Wanted>(wanted, "wishes")?);
    written(judged().map_or_else(Answer::Error, Answer::Plan))
}

/// Describes all series.
pub fn describe(headers: &[u8]) -> String {
    let described = || judging::describe(&read::<Headers>(headers, "headers")?);
    written(described().map_or_else(Answer::Error, Answer::Series))
}

/// Reads a document; what is wrong with it is told by its place, as the words of the parser quote values.
fn read<T: DeserializeOwned>(document: &[u8], what: &str) -> Result<T> {
    serde_json::from_slice(document).map_err(|error| {
        let found = format!("{what} of another form at line {}, column {}", error.line(), error.column());
        Error::new(found, "a document as lumencut-dicom describes it")
    })
}

fn written(answer: Answer) -> String {
    serde_json::to_string(&answer).unwrap_or_default()
}
