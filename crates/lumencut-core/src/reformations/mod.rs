//! Reformations: methods that find where each pixel looks in another way than the cut surface does. What is shown there is
//! up to `look` ([`crate::pipeline`]).

pub mod cpr;
pub mod frames;
pub mod path;
