//! The functions of this crate with JSON as input and output, for programs in other languages. The input is
//! [`Headers`] and [`Wanted`]. The output is `{"plan": …}` with a [`Plan`], `{"series": […]}` with [`Report`]s, or
//! `{"error": …}` with an [`Error`].

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::error::{Error, Result};
use crate::headers::Headers;
use crate::judging::{self, Wanted};
use crate::plan::Plan;
use crate::report::Report;

#[derive(Serialize)]
#[serde(rename_all = "snake_case")]
enum Answer<'a> {
    Plan(&'a Plan),
    Series(&'a [Report]),
    Error(&'a Error),
}

/// Plans a volume; see [`crate::judge`].
pub fn judge(headers: &[u8], wanted: &[u8]) -> String {
    let judged = || judging::judge(&read::<Headers>(headers, "headers")?, &read::<Wanted>(wanted, "wishes")?);
    match judged() {
        Ok(plan) => written(&Answer::Plan(&plan)),
        Err(error) => written(&Answer::Error(&error)),
    }
}

/// Describes all series; see [`crate::describe`].
pub fn describe(headers: &[u8]) -> String {
    match read::<Headers>(headers, "headers").and_then(|headers| judging::describe(&headers)) {
        Ok(series) => written(&Answer::Series(&series)),
        Err(error) => written(&Answer::Error(&error)),
    }
}

/// Error messages state only the position, because the message of the parser quotes values.
fn read<T: DeserializeOwned>(document: &[u8], what: &str) -> Result<T> {
    serde_json::from_slice(document).map_err(|error| {
        let found =
            format!("{what} in an unexpected form at line {}, column {}", error.line(), error.column());
        Error::new(found, "the JSON form of lumencut-dicom")
    })
}

fn written(answer: &Answer) -> String {
    serde_json::to_string(answer).unwrap_or_default()
}
