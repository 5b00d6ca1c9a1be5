//! All tests of tracing and measuring from outside, in one program.

mod dark_lumens;
mod errors;
mod find_from_seed;
mod find_one_vessel;
mod find_phantoms;
mod find_stops;
mod flaps;
mod lumens_on_ray;
mod measure;
mod measure_disturbed;
mod measure_stenoses;
mod measure_surroundings;
mod measure_tubes;
mod measure_walls;
mod outer_wall;
mod scans;
mod throats;
mod trace_clicks;
mod trace_flaps;
mod trace_mask;
mod trace_mask_tubes;
mod trace_rooms;
mod trace_tubes;
mod trace_walls;
