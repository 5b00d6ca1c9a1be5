//! How a viewer asks the study: every question has a name, a message and an answer, all three in one table
//! ([`crate::study::questions`]), of which the types of the page are written.

use serde::{Deserialize, Serialize};

use crate::study::failure::{Failure, Result};
use crate::study::open_study::Picture;
use crate::study::reformed::ReformedPicture;
use crate::study::tracing::Watch;

/// When a question is answered, where a viewer has one thread for its study.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turn {
    /// The user waits for it: the view under way gives way.
    First,
    /// As [`Turn::First`], and it takes a while: a cancellation stops it, also before it begins, and these words say what is done.
    Long(&'static str),
    /// After the view under way.
    Later,
    /// At once, beside whatever is under way: it asks nothing of the study.
    AtOnce,
}

/// What comes with a message.
#[derive(Clone, Copy)]
pub struct Asking<'a> {
    /// The message as JSON.
    pub message: &'a str,
    /// The bytes of a file; empty for questions that take none.
    pub bytes: &'a [u8],
    /// Whether to stop, and how far the work is.
    pub watch: Watch<'a>,
    /// A clock (ms).
    pub clock: &'a (dyn Fn() -> f64 + Sync),
}

/// An answer.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// As JSON.
    pub json: String,
    /// Bytes beside the JSON, as those of a picture: the field `bytes` of the answer.
    pub bytes: Option<Vec<u8>>,
}

/// The bytes of a file that is written.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct WrittenFile {
    /// All of them.
    #[cfg_attr(test, ts(type = "Bytes"))]
    pub bytes: Vec<u8>,
}

/// What can be an answer.
pub(crate) trait Answering {
    /// As it is sent.
    ///
    /// # Errors
    /// `settings` for what JSON cannot hold.
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
        let told = serde_json::json!({ "size": size, "words": words, "pixel_spacing": pixel_spacing, "marks": marks });
        Ok(Answer { json: as_json(&told)?, bytes: Some(bytes) })
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

/// The message of a question.
///
/// # Errors
/// `settings` for a text that is not its message.
pub(crate) fn read<'a, T: Deserialize<'a>>(question: &str, text: &'a str) -> Result<T> {
    let subject = format!("message of the question {question}");
    serde_json::from_str(text).map_err(|error| Failure::of_message(&subject, &error, "JSON of its type"))
}

/// Declares the table of questions, a row for each: what it answers, when, its name, its message (`(name: Type)` for all of it, or
/// `{ name: Type, … }` for its fields), the type of the answer, and how it is answered. A row sees the study and the asking by the
/// names at the head of the table; `?` ends it with an error. Rows under `at_once` see neither.
macro_rules! questions {
    (
        |$study:ident, $asking:ident|
        of_the_study { $( $(#[doc = $about:literal])+ [$turn:expr] $name:ident $message:tt -> $answer:ty = $body:expr; )+ }
        at_once { $( $(#[doc = $now_about:literal])+ $now:ident $now_message:tt -> $now_answer:ty = $now_body:expr; )+ }
    ) => {
        $( questions!(@row $study $asking $name $message $answer = $body); )+
        $( questions!(@row_at_once $now $now_message $now_answer = $now_body); )+

        impl Study {
            /// Answers the question of a name; its message is [`Asking::message`].
            ///
            /// # Errors
            /// Those of the question, `settings` for another name or message.
            pub fn ask(&mut self, name: &str, asking: &Asking) -> Result<Answer> {
                match name {
                    $( stringify!($name) => $name::answer(self, read(name, asking.message)?, asking), )+
                    other => Err(Failure::of_message("question", &other, "one of the table of questions")),
                }
            }
        }

        /// Answers a question that asks nothing of a study.
        ///
        /// # Errors
        /// Those of the question, `settings` for another name or message.
        pub fn ask_at_once(name: &str, message: &str) -> Result<Answer> {
            match name {
                $( stringify!($now) => $now::answer(read(name, message)?), )+
                other => Err(Failure::of_message("question", &other, "one of the table of questions")),
            }
        }

        /// When each question is answered.
        pub const TURNS: &[(&str, Turn)] =
            &[$((stringify!($name), $turn),)+ $((stringify!($now), Turn::AtOnce),)+];

        /// Tells every row to what writes the types of the page.
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
            #[allow(clippy::allow_attributes, unused_imports, reason = "what one row names another one may not")]
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
