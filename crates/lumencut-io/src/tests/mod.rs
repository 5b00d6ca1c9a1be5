//! Tests on small files that are written here, in every encoding.

mod formats;
mod joining;
mod robust;
mod sample;
mod writing;
