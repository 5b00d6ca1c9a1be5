//! Tests that reading usual large files takes at most ten file sizes of memory, in all formats.
#![allow(unsafe_code, clippy::unwrap_used)]

#[path = "../../fuzz/src/memory.rs"]
mod memory;
mod poly_data;
mod rows;

use lumencut_io::{Line, junctions, read, write_mrk_json, write_vtp};
use poly_data::{segments, vtk, vtp};
use rows::{npy, pth, slicer, swc, text, tre};

const MOST_TIMES: usize = 10;
const BRANCHES: usize = 20;

type Row = [f64; 4];

/// Branches of a tree, each from a point of the one before it, with realistic numbers of digits.
fn branches(points: usize) -> Vec<Vec<Row>> {
    let mut random = 0x2545_f491_4f6c_dd1d_u64;
    let mut noise = || {
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        f64::from((random >> 40) as u32) / f64::from(1 << 24) - 0.5
    };
    let mut out: Vec<Vec<Row>> = Vec::new();
    for branch in 0..BRANCHES {
        let mut at = out.last().map_or([-120.0, 80.0, -400.0, 12.0], |before| before[before.len() / 2]);
        let way = [noise(), noise(), noise()];
        let mut rows = vec![at];
        for _ in 1..points / BRANCHES + branch {
            (0..3).for_each(|axis| at[axis] += (way[axis] + 0.2 * noise()) * 0.05);
            at[3] = (at[3] + 0.01 * noise()).clamp(0.5, 15.0);
            rows.push(at);
        }
        out.push(rows);
    }
    out
}

fn with_trunks(tree: &[Vec<Row>]) -> Vec<Vec<Row>> {
    let mut out: Vec<Vec<Row>> = Vec::new();
    for rows in tree {
        let trunk = out.last().map_or(&[][..], |before| {
            let at = before.iter().position(|row| row == &rows[0]).unwrap_or(0);
            &before[at.saturating_sub(2000)..at]
        });
        out.push([trunk, rows].concat());
    }
    out
}

fn lines(tree: &[Vec<Row>]) -> Vec<Line> {
    let line = |rows: &Vec<Row>| Line {
        points: rows.iter().map(|[x, y, z, _]| [*x, *y, *z].into()).collect(),
        radius: Some(rows.iter().map(|row| row[3]).collect()),
        ..Line::default()
    };
    tree.iter().map(line).collect()
}

#[test]
fn no_large_file_takes_more_than_ten_times_its_size() {
    let mut wrong = Vec::new();
    let tree = branches(140_000);
    let files = [
        ("ascii", "a.vtp", vtp(&tree, "ascii")),
        ("raw", "a.vtp", vtp(&tree, "raw")),
        ("zlib", "a.vtp", vtp(&tree, "zlib")),
        ("zlib, trunks", "a.vtp", vtp(&with_trunks(&tree), "zlib")),
        ("ascii, trunks", "a.vtp", vtp(&with_trunks(&tree), "ascii")),
        ("written", "a.vtp", write_vtp(&lines(&tree)).unwrap()),
        ("ascii", "a.vtk", vtk(&tree, false)),
        ("binary", "a.vtk", vtk(&tree, true)),
        ("segments", "a.vtk", segments(&tree)),
        ("Slicer's", "a.mrk.json", slicer(&tree)),
        ("written", "a.mrk.json", write_mrk_json(&lines(&tree)).unwrap()),
        ("", "a.pth", pth(&tree)),
        ("", "a.swc", swc(&tree)),
        ("text", "a.tre", tre(&tree, false)),
        ("binary", "a.tre", tre(&tree, true)),
        (
            "",
            "a.fcsv",
            text(&tree, "# Markups fiducial file version = 4.11\n", |_, k, [x, y, z, _]| {
                format!("{k},{x:.3},{y:.3},{z:.3},0,0,0,1,1,1,0,F-{k},,\n")
            }),
        ),
        (
            "",
            "reference.txt",
            text(&tree, "", |_, _, [x, y, z, r]| format!("{x:.6} {y:.6} {z:.6} {r:.6} 0.1\n")),
        ),
        (
            "4 columns",
            "a.csv",
            text(&tree, "line,x,y,z,r\n", |i, _, [x, y, z, r]| format!("{i},{x:.3},{y:.3},{z:.3},{r:.3}\n")),
        ),
        ("3 columns", "a.csv", text(&tree, "", |_, _, [x, y, z, _]| format!("{x:.2},{y:.2},{z:.2}\n"))),
        ("f4 x 3", "a.npy", npy(&tree, 3, false)),
        ("f4 x 4", "a.npy", npy(&tree, 4, false)),
        ("f8 x 4", "a.npy", npy(&tree, 4, true)),
    ];
    for (what, name, bytes) in files {
        let (vessels, peak) =
            memory::peak_of(|| read(&bytes, name).and_then(|read| read.scaled(1.0)).map(junctions::vessels));
        let vessels = vessels.unwrap_or_else(|error| panic!("{what}: {error}")).lines.len();
        let told =
            format!("{name} {what}: {:.1} times {} bytes", peak as f64 / bytes.len() as f64, bytes.len());
        println!("{told}, {vessels} vessel(s)");
        assert!(bytes.len() >= 1 << 20, "{told}");
        wrong.extend((peak > MOST_TIMES * bytes.len()).then_some(told));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
