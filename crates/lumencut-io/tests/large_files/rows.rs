//! Test data: a tree in the formats that have one row per point.

use std::fmt::Write as _;
use std::io::Write as _;

use crate::Row;

pub fn text(tree: &[Vec<Row>], head: &str, row: impl Fn(usize, usize, &Row) -> String) -> Vec<u8> {
    let mut out = head.to_owned();
    for (i, rows) in tree.iter().enumerate() {
        rows.iter().enumerate().for_each(|(k, values)| out.push_str(&row(i, k, values)));
    }
    out.into_bytes()
}

pub fn swc(tree: &[Vec<Row>]) -> Vec<u8> {
    let mut out = String::new();
    let (mut id, mut parent) = (0, -1);
    for rows in tree {
        let begin = id + 1 - i64::from(parent > 0);
        for [x, y, z, r] in rows.iter().skip(usize::from(parent > 0)) {
            id += 1;
            writeln!(out, "{id} 3 {x:.4} {y:.4} {z:.4} {r:.4} {parent}").unwrap();
            parent = id;
        }
        parent = begin + (rows.len() / 2) as i64;
    }
    out.into_bytes()
}

pub fn pth(tree: &[Vec<Row>]) -> Vec<u8> {
    let mut out = String::new();
    for (i, rows) in tree.iter().enumerate() {
        writeln!(out, "<path id=\"{i}\"><timestep id=\"0\"><path_element><path_points>").unwrap();
        for (k, [x, y, z, _]) in rows.iter().enumerate() {
            write!(out, "<path_point id=\"{k}\">\n<pos x=\"{x}\" y=\"{y}\" z=\"{z}\" />\n</path_point>\n")
                .unwrap();
        }
        out.push_str("</path_points></path_element></timestep></path>\n");
    }
    out.into_bytes()
}

pub fn tre(tree: &[Vec<Row>], binary: bool) -> Vec<u8> {
    let mut out = Vec::new();
    for (i, rows) in tree.iter().enumerate() {
        let count = rows.len();
        writeln!(
            out,
            "ObjectType = Tube\nNDims = 3\nID = {i}\nBinaryData = {binary}\nPointDim = x y z r\n\
             NPoints = {count}\nPoints = "
        )
        .unwrap();
        for row in rows {
            if binary {
                row.iter().for_each(|v| out.extend((*v as f32).to_le_bytes()));
            } else {
                let [x, y, z, r] = row;
                writeln!(out, "{x:.5} {y:.5} {z:.5} {r:.4}").unwrap();
            }
        }
        out.push(b'\n');
    }
    out
}

pub fn npy(tree: &[Vec<Row>], columns: usize, wide: bool) -> Vec<u8> {
    let rows: Vec<&Row> = tree.iter().flatten().collect();
    let kind = if wide { "<f8" } else { "<f4" };
    let head =
        format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({}, {columns}), }}\n", rows.len());
    let mut out = b"\x93NUMPY\x01\x00".to_vec();
    out.extend((head.len() as u16).to_le_bytes());
    out.extend(head.bytes());
    for value in rows.iter().flat_map(|row| &row[..columns]) {
        if wide {
            out.extend(value.to_le_bytes());
        } else {
            out.extend((*value as f32).to_le_bytes());
        }
    }
    out
}

pub fn slicer(tree: &[Vec<Row>]) -> Vec<u8> {
    let mut out = "{\n    \"markups\": [\n".to_owned();
    for (i, rows) in tree.iter().enumerate() {
        out.push_str(if i > 0 { ",\n" } else { "" });
        out.push_str("{\n \"type\": \"Curve\",\n \"coordinateSystem\": \"LPS\",\n \"controlPoints\": [\n");
        for (k, [x, y, z, _]) in rows.iter().enumerate() {
            out.push_str(if k > 0 { ",\n" } else { "" });
            write!(
                out,
                "{{\n \"id\": \"{k}\",\n \"label\": \"C-{k}\",\n \"position\": [{x}, {y}, {z}],\n \
                 \"orientation\": [-1.0, -0.0, -0.0, -0.0, -1.0, -0.0, 0.0, 0.0, 1.0],\n \
                 \"selected\": true,\n \"positionStatus\": \"defined\"\n}}"
            )
            .unwrap();
        }
        out.push_str("]}");
    }
    (out + "]}\n").into_bytes()
}
