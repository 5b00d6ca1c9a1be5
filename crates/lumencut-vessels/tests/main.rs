//! All tests of tracing and measuring from outside, in one program.

mod errors;
mod find_from_seed;
mod find_one_vessel;
mod find_stops;
mod lumens_on_ray;
mod measure;
mod measure_surroundings;
mod flaps;
mod outer_wall;
mod throats;
mod trace_clicks;
mod trace_flaps;
mod trace_mask;
mod trace_rooms;
mod trace_walls;
