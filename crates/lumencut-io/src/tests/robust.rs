//! Tests that damaged files give an error or valid lines.

use glam::DVec3;

use super::sample;
use crate::junctions::vessels;
use crate::{Centerlines, Line, read};

fn read_and_check(bytes: &[u8], name: &str) -> bool {
    let Ok(read) = read(bytes, name) else { return false };
    for line in read.lines.iter().chain(&vessels(read.clone()).lines) {
        assert!(line.points.len() >= 2 && line.points.iter().all(|p| p.is_finite()));
        assert!(line.radius.as_ref().is_none_or(|radius| radius.len() == line.points.len()));
    }
    true
}

#[test]
fn a_file_cut_anywhere_is_an_error_or_gives_all_its_lines() {
    let text = ["a.pth", "a.swc", "a.tre", "a.fcsv", "reference.txt", "a.txt", "a.csv"];
    for (bytes, name) in sample::files() {
        assert!(read_and_check(&bytes, name));
        for length in 0..bytes.trim_ascii_end().len() {
            if !read_and_check(&bytes[..length], name) {
                continue;
            }
            // Tables may end after any row.
            if text.contains(&name) {
                continue;
            }
            // A legacy file may end between sections unnoticed; the closing tag of appended data is optional.
            let lines = read(&bytes[..length], name).unwrap().lines;
            let appended = bytes.windows(13).any(|w| w == b"<AppendedData") && bytes.len() - length < 64;
            assert!(name == "a.vtk" || appended, "{name} cut at {length} of {}", bytes.len());
            let points: Vec<_> = lines.into_iter().map(|line| line.points).collect();
            assert_eq!(
                points,
                [sample::line(0), sample::line(1)],
                "{name} cut at {length} of {}",
                bytes.len()
            );
        }
    }
}

/// Random numbers from a seed (xorshift), so that failures can be repeated.
pub struct Random(pub u64);

impl Random {
    pub fn below(&mut self, limit: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % limit as u64) as usize
    }
}

const NASTY: [&[u8]; 12] = [
    b"-1",
    b"99999999999999999999",
    b"nan",
    b"\xff\xff\xff\xff",
    b"\0\0\0\0\0\0\0\x80",
    b"<",
    b"</a>",
    b"\"",
    b"[",
    b"\n",
    b"=",
    b"1e308",
];

#[test]
fn mutated_files_never_panic() {
    let mut files = sample::files();
    // As many files of other formats are tested as there are variants of `.vtp`.
    let others: Vec<_> =
        sample::other_files().into_iter().map(|(content, name, _)| (content, name)).collect();
    files.extend(others.iter().cycle().take(64).cloned());
    let mut random = Random(0x2545_f491_4f6c_dd1d);
    let mut read_whole = 0;
    for round in 0..20_000 {
        let (original, name) = &files[round % files.len()];
        let mut bytes = original.clone();
        for _ in 0..=random.below(3) {
            let at = random.below(bytes.len());
            let nasty = NASTY[random.below(NASTY.len())];
            match random.below(4) {
                0 => bytes[at] ^= 1 << random.below(8),
                1 => drop(bytes.splice(at..at, nasty.iter().copied())),
                2 => drop(bytes.splice(at..(at + nasty.len()).min(bytes.len()), nasty.iter().copied())),
                _ => drop(bytes.drain(at..(at + random.below(9)).min(bytes.len() - 1).max(at))),
            }
        }
        read_whole += usize::from(read_and_check(&bytes, name));
    }
    assert!((1..20_000).contains(&read_whole), "{read_whole} of the mutated files were read");
}

#[test]
fn any_bytes_after_a_known_beginning_never_panic() {
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let names = ["a.vtp", "a.vtk", "a.mrk.json", "a.csv", "a.fcsv", "a.pth", "a.swc", "a.tre", "a.npy"];
    let beginnings: [&[u8]; 6] =
        [b"", b"# vtk DataFile Version 5.1\n", b"<VTKFile", b"{", b"\x93NUMPY", b"x,y,z\n"];
    for round in 0..6_000 {
        let mut bytes = beginnings[random.below(beginnings.len())].to_vec();
        for _ in 0..random.below(300) {
            bytes.push(random.below(256) as u8);
        }
        if random.below(3) == 0 {
            bytes.extend(NASTY[random.below(NASTY.len())]);
        }
        read_and_check(&bytes, names[round % names.len()]);
    }
}

/// If every point is near every segment, comparing all of them would take quadratic time.
#[test]
fn radii_as_wide_as_the_tree_end_in_time() {
    const COUNT: usize = 30_000;
    let line = |y: f64| Line {
        points: (0..COUNT).map(|i| DVec3::new(i as f64, y, (i % 2) as f64 * 1e-3)).collect(),
        radius: Some(vec![1e6; COUNT]),
        ..Line::default()
    };
    let found = vessels(Centerlines { lines: vec![line(0.0), line(5.0)], ..Centerlines::default() });
    assert!(found.notes.contains(&"lines near too many others were joined only at coincident points".into()));
    assert_eq!(found.lines.len(), 2);
}

/// Lines stay even if all of their points would be merged.
#[test]
fn lines_shorter_than_the_weld_distance_stay() {
    for (at, step) in [(0.0, 1e-310), (1e6, 1e-7), (1e-200, 1e-205)] {
        let points = vec![DVec3::splat(at), DVec3::splat(at + step)];
        let lines = vec![Line { points, ..Line::default() }];
        let found = vessels(Centerlines { lines: lines.clone(), ..Centerlines::default() });
        assert_eq!(found.lines, lines);
    }
}
