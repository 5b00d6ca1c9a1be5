//! How a viewer asks the study: by questions with a name, a message and an answer. The table [`crate::study::questions`] declares
//! them, and the page's types are generated from it.

use serde::{Deserialize, Serialize};

use crate::study::failure::{Failure, Result};
use crate::study::open_study::Picture;
use crate::study::reformations::ReformedPicture;
use crate::study::tracing::Watch;

/// When a viewer with only one thread answers a question.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turn {
    /// Before the view in progress, which is interrupted.
    First,
    /// As [`Turn::First`], for long work that can be cancelled, even before it starts. The words name the work.
    Long(&'static str),
    /// After the view in progress.
    Later,
    /// Immediately, without the study.
    AtOnce,
}

/// The input of a question.
#[derive(Clone, Copy)]
pub struct Asking<'a> {
    /// The message of the question as JSON.
    pub message: &'a str,
    /// The bytes of a file; empty without a file.
    pub bytes: &'a [u8],
    /// Stops the work, and receives its progress.
    pub watch: Watch<'a>,
    /// A clock (ms).
    pub clock: &'a (dyn Fn() -> f64 + Sync),
}

/// The answer to a question.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// The answer as JSON.
    pub json: String,
    /// Binary content, such as a picture; it becomes the field `bytes` of the answer.
    pub bytes: Option<Vec<u8>>,
}

/// The bytes of a written file.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct WrittenFile {
    /// The content.
    #[cfg_attr(test, ts(type = "Bytes"))]
    pub bytes: Vec<u8>,
}

/// A type that can be sent as an answer.
pub(crate) trait Answering {
    fn sent(self) -> Result<Answer>;
}

impl<T: Serialize> Answering for T {
    fn sent(self) -> Result<Answer> {
        Ok(Answer { json: as_json(&self)?, bytes: None })
    }
}

impl Answering for Picture {
    fn sent(self) -> Result<Answer> {
        let json = format!("{{\"size\":{}}}", as_json(&self.size)?);
        Ok(Answer { json, bytes: Some(self.bytes) })
    }
}

impl Answering for ReformedPicture {
    fn sent(self) -> Result<Answer> {
        let Self { size, bytes, words, pixel_spacing, marks } = self;
        let content = serde_json::json!({ "size": size, "words": words, "pixel_spacing": pixel_spacing, "marks": marks });
        Ok(Answer { json: as_json(&content)?, bytes: Some(bytes) })
    }
}

impl Answering for WrittenFile {
    fn sent(self) -> Result<Answer> {
        Ok(Answer { json: "{}".to_owned(), bytes: Some(self.bytes) })
    }
}

fn as_json(value: &impl Serialize) -> Result<String> {
    serde_json::to_string(value).map_err(|error| Failure::of_message("answer", &error, "JSON"))
}

pub(crate) fn read<'a, T: Deserialize<'a>>(question: &str, text: &'a str) -> Result<T> {
    let subject = format!("message of the question {question}");
    serde_json::from_str(text).map_err(|error| Failure::of_message(&subject, &error, "JSON of its type"))
}

/// Declares the table of questions. A row has a doc comment, turn, name, message (`(name: Type)` or `{ name: Type, … }`), answer
/// type and body. Bodies use the study and the [`Asking`] under the names given first, and may use `?`. Rows under `at_once` have
/// no access to either.
macro_rules! questions {
    (
        |$study:ident, $asking:ident|
        of_the_study { $( $(#[doc = $about:literal])+ [$turn:expr] $name:ident $message:tt -> $answer:ty = $body:expr; )+ }
        at_once { $( $(#[doc = $now_about:literal])+ $now:ident $now_message:tt -> $now_answer:ty = $now_body:expr; )+ }
    ) => {
        $( questions!(@row $study $asking $name $message $answer = $body); )+
        $( questions!(@row_at_once $now $now_message $now_answer = $now_body); )+

        impl Study {
            /// Answers the question `name`. Fails as the question does, and with kind `settings` for an unknown name
            /// or an invalid message.
            pub fn ask(&mut self, name: &str, asking: &Asking) -> Result<Answer> {
                match name {
                    $( stringify!($name) => $name::answer(self, read(name, asking.message)?, asking), )+
                    other => Err(Failure::of_message("question", &other, "one of the table of questions")),
                }
            }
        }

        /// Answers a question that needs no study. Fails as the question does, and with kind `settings` for an
        /// unknown name or an invalid message.
        pub fn ask_at_once(name: &str, message: &str) -> Result<Answer> {
            match name {
                $( stringify!($now) => $now::answer(read(name, message)?), )+
                other => Err(Failure::of_message("question", &other, "one of the table of questions")),
            }
        }

        /// When each question is answered.
        pub const TURNS: &[(&str, Turn)] =
            &[$((stringify!($name), $turn),)+ $((stringify!($now), Turn::AtOnce),)+];

        /// Passes every row to the generator of the page's types.
        #[cfg(test)]
        pub(crate) fn declare(types: &mut crate::study::tests::typescript::Types) {
            $( types.question::<$name::Message, $answer>(stringify!($name), &[$($about),+], $turn); )+
            $( types.question::<$now::Message, $now_answer>(stringify!($now), &[$($now_about),+], Turn::AtOnce); )+
        }
    };
    (@message ($argument:ident: $type:ty)) => {
        pub type Message = $type;
    };
    (@message { $($field:ident: $type:ty),+ $(,)? }) => {
        #[derive(serde::Deserialize)]
        #[cfg_attr(test, derive(ts_rs::TS))]
        pub struct Message {
            $( pub $field: $type, )+
        }
    };
    (@taken $given:ident ($argument:ident: $type:ty)) => {
        let $argument = $given;
    };
    (@taken $given:ident { $($field:ident: $type:ty),+ $(,)? }) => {
        let Message { $($field),+ } = $given;
    };
    (@row $study:ident $asking:ident $name:ident $message:tt $answer:ty = $body:expr) => {
        mod $name {
            #[allow(clippy::allow_attributes, unused_imports, reason = "rows use different imports")]
            use super::*;

            questions!(@message $message);

            pub(super) fn answer($study: &mut Study, given: Message, $asking: &Asking) -> Result<Answer> {
                questions!(@taken given $message);
                let _ = $asking;
                <$answer as Answering>::sent($body)
            }
        }
    };
    (@row_at_once $name:ident $message:tt $answer:ty = $body:expr) => {
        mod $name {
            use super::*;

            questions!(@message $message);

            pub(super) fn answer(given: Message) -> Result<Answer> {
                questions!(@taken given $message);
                <$answer as Answering>::sent($body)
            }
        }
    };
}
pub(crate) use questions;
