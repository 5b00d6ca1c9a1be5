//! A host that reads files from memory.

use std::collections::BTreeMap;

use lumencut_volumes::{Error, Fill, Found, Kind, Known, Need, Plan, Step, Stop, Window, open};

pub type Files<'a> = BTreeMap<&'a str, Vec<u8>>;

pub fn opened(files: &Files, name: &str, chosen: Option<&[u32]>) -> Result<Plan, Stop> {
    let mut known = Known::new();
    loop {
        match open(name, &known, chosen) {
            Err(Stop::Need(Need::Sizes(names))) => {
                for name in names {
                    let size = files.get(name.as_str()).map(|bytes| bytes.len() as u64);
                    known.add_size(&name, size.map_or(Found::Missing, Found::Size));
                }
            }
            Err(Stop::Need(Need::Bytes { name, start, end })) => {
                let bytes = &files[name.as_str()];
                let end = (end as usize).min(bytes.len());
                known.add_bytes(&name, start, &bytes[start as usize..end]);
            }
            other => return other,
        }
    }
}

/// The voxels of a file; the host reads at most `most` bytes at once, and its output has the same size.
pub fn filled(plan: Plan, bytes: &[u8], in_engine: bool, most: usize) -> Result<(Kind, Vec<u8>), Box<Error>> {
    let mut fill = Fill::new(plan, bytes.len() as u64, in_engine);
    let (mut kind, mut voxels, mut at) = (Kind::Uint8, Vec::new(), 0);
    let mut window = Window::default();
    loop {
        let end = voxels.len().min(at + most.max(8));
        match fill.step(window, &mut voxels[at..end])? {
            Step::Read { start, end } => {
                let start = start as usize;
                // At least three bytes, which show whether another part of a stream begins.
                let end = (end as usize).min(bytes.len()).min(start + most.max(3));
                window = Window { start: start as u64, bytes: &bytes[start.min(end)..end] };
                assert!(most > 1 << 20 || !window.bytes.is_empty() || start == bytes.len());
            }
            Step::Sound { .. } | Step::Checked(_) => {}
            Step::Room { kind: found, bytes } => {
                (kind, voxels) = (found, vec![0; bytes as usize]);
            }
            Step::Filled(count) => at += count,
            Step::Done => {
                assert_eq!(at, voxels.len());
                return Ok((kind, voxels));
            }
        }
    }
}

pub fn read(files: &Files, name: &str, in_engine: bool) -> Result<(Plan, Kind, Vec<u8>), Box<Error>> {
    let plan = opened(files, name, None).map_err(refused)?;
    let Some(bytes) = files.get(plan.place.name.as_str()) else { return Err(plan.missing()) };
    let (kind, voxels) = filled(plan.clone(), bytes, in_engine, usize::MAX >> 1)?;
    Ok((plan, kind, voxels))
}

pub fn refused(stop: Stop) -> Box<Error> {
    match stop {
        Stop::Refused(error) => error,
        other => panic!("{other:?}"),
    }
}
