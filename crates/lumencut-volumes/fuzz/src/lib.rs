//! Properties that must hold for any bytes that are read as a volume file.

#[path = "../../../lumencut-io/fuzz/src/memory.rs"]
mod memory;

use lumencut_volumes::{Fill, Found, Known, Need, Step, Stop, Window, open};

/// Maximum memory for reading a file without its voxels, as a multiple of the file's size.
const MOST_TIMES: usize = 10;
/// Files smaller than this (bytes) may use as much memory as a file of this size.
const SMALL: usize = 2 << 20;
/// Voxels of larger volumes (bytes) are not read.
const MOST_VOXELS: u64 = 1 << 26;

/// Reads `data` as a file with this name, for Python and for the page. Panics if reading does not end, voxels are
/// missing, or memory exceeds its limit.
pub fn check(data: &[u8], name: &str) {
    for in_engine in [false, true] {
        let ((), peak) = memory::peak_of(|| read(data, name, in_engine));
        let most = MOST_TIMES * data.len().max(SMALL);
        assert!(peak <= most, "reading {} bytes took {peak} bytes, more than {most}", data.len());
    }
}

fn read(data: &[u8], name: &str, in_engine: bool) {
    let mut known = Known::new();
    let plan = loop {
        match open(name, &known, None) {
            Ok(plan) => break plan,
            Err(Stop::Need(Need::Sizes(names))) => names.iter().for_each(|one| {
                let size = Found::Size(data.len() as u64);
                known.add_size(one, if one == name { size } else { Found::Missing });
            }),
            Err(Stop::Need(Need::Bytes { name, start, end })) => {
                known.add_bytes(&name, start, &data[start as usize..end as usize]);
            }
            Err(Stop::Unknown | Stop::Refused(_)) => return,
        }
    };
    let (mut left, mut output) = (0, [0; 1 << 16]);
    let mut fill = Fill::new(plan, data.len() as u64, in_engine);
    loop {
        let room = left.min(output.len() as u64) as usize;
        match fill.step(Window { start: 0, bytes: data }, &mut output[..room]) {
            Ok(Step::Read { .. }) => panic!("more than the whole file is needed"),
            Ok(Step::Room { bytes, .. }) if bytes > MOST_VOXELS => return,
            Ok(Step::Room { bytes, .. }) => left = bytes,
            Ok(Step::Sound { .. } | Step::Checked(_)) => {}
            Ok(Step::Filled(count)) => {
                assert!(count > 0, "no voxels came");
                left -= count as u64;
            }
            Ok(Step::Done) => return assert_eq!(left, 0, "voxels are missing"),
            Err(_) => return,
        }
    }
}
