//! Tests on small files that are written here, in every encoding, and on the shared samples where they are.

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
