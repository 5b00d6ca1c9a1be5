//! Tests on generated files in every encoding, and on samples from other programs if present.

mod formats;
mod hostile;
mod joining;
mod markups;
mod other_formats;
mod robust;
mod sample;
mod segments;
mod session;
mod shared_data;
mod tables;
mod writing;
