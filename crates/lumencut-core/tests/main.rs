//! All tests of the core in one program, except `memory.rs`, which counts allocations in its own process.

mod along_rays;
mod bad_input;
mod centerline_smoothing;
mod chosen;
mod context;
mod context_forms;
mod context_invariants;
mod cr;
mod cut_surface;
mod depth_filter;
mod errors;
mod focus;
mod hierarchy_equals_brute_force;
mod independence;
mod leaps;
mod lines;
mod mpcpr;
mod one_decision;
mod paper;
mod rim;
mod scene;
mod settings;
mod stages;
mod table;
mod three_tiers;
