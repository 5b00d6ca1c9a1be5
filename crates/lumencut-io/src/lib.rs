//! Readers of centerline files: one room per format.
