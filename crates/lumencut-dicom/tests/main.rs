//! All tests of the judge from outside, in one program.

mod geometry;
mod made;
mod mends;
mod repeated;
mod scan;
mod series;
