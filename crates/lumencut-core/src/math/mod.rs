//! The arithmetic that the stages share.

pub mod window;
