//! Reads files of every format: closed forms, damaged files, streams of several parts, files that claim too much.
#![allow(clippy::unwrap_used)]

mod host;

use std::io::Write;

use flate2::Compression;
use flate2::write::{GzEncoder, ZlibEncoder};
use host::{Files, filled, opened, read, refused};
use lumencut_volumes::{Codec, ErrorKind, Format, Kind, Packer, Scaling, Stop, Written, format_of};

const SIZE: [u64; 3] = [4, 3, 2];
const AFFINE: [[f64; 4]; 3] = [[0.5, 0.125, 0.0, -10.0], [0.0, 0.75, 0.0, 20.0], [0.0, 0.0, -2.0, 30.0]];

const MHD: &str = "ObjectType = Image\nNDims = 3\nDimSize = 4 3 2\nElementSpacing = 0.5 0.75 2\n\
                   ElementType = MET_SHORT\nCompressedData = True\nElementDataFile = a.zraw\n";

fn written(kind: Kind) -> Written<'static> {
    Written { size: SIZE, world_from_index: AFFINE, kind, mark: "a mark" }
}

fn ramp() -> Vec<u8> {
    (0..24_i16).flat_map(|value| (value * 100 - 1000).to_ne_bytes()).collect()
}

fn gzipped(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

fn zlibbed(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

fn bzipped(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = bzip2::write::BzEncoder::new(Vec::new(), bzip2::Compression::best());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

fn nifti() -> Vec<u8> {
    [written(Kind::Int16).nifti(), ramp()].concat()
}

fn nrrd(encoding: &str, voxels: &[u8]) -> Vec<u8> {
    let header = written(Kind::Int16).nrrd(false).replace("encoding: raw", &format!("encoding: {encoding}"));
    [header.as_bytes(), voxels].concat()
}

#[test]
fn what_is_written_is_read() {
    let mut packer = Packer::default();
    let packed = [packer.pack(&nifti()), packer.end()].concat();
    let files = Files::from([
        ("a.nii", nifti()),
        ("a.nii.gz", packed),
        ("a.nrrd", nrrd("raw", &ramp())),
        ("b.nrrd", nrrd("gzip", &gzipped(&ramp()))),
    ]);
    for name in files.keys() {
        let (plan, kind, voxels) = read(&files, name, false).unwrap();
        assert_eq!((plan.grid.size, plan.grid.world_from_index), (SIZE, AFFINE), "{name}");
        assert_eq!((kind, voxels), (Kind::Int16, ramp()), "{name}");
        assert!(plan.grid.states_spacing && plan.grid.states_orientation && plan.notes.is_empty());
        assert_eq!(plan.description.trim_end_matches('\0'), "a mark");
    }
}

#[test]
fn a_long_axis_is_written_as_nifti_2() {
    let long = Written { size: [40000, 1, 1], ..written(Kind::Uint8) };
    let files = Files::from([("a.nii", [long.nifti(), vec![7; 40000]].concat())]);
    let (plan, _, voxels) = read(&files, "a.nii", false).unwrap();
    assert_eq!((plan.format, plan.grid.size), (Format::Nifti2, [40000, 1, 1]));
    assert_eq!((plan.grid.world_from_index, voxels), (AFFINE, vec![7; 40000]));
}

#[test]
fn the_host_may_read_little_at_once() {
    let parts = [gzipped(&nifti()[..400]), gzipped(&[]), gzipped(&nifti()[400..]), b"rest".to_vec()].concat();
    let text: String = (0..24).map(|value| format!(" {}\n", value * 100 - 1000)).collect();
    let files = Files::from([
        ("a.nii.gz", parts),
        ("a.nrrd", nrrd("text", text.as_bytes())),
        ("b.nrrd", nrrd("raw", &ramp())),
    ]);
    for (name, bytes) in &files {
        for most in [3, 8, 17, 1 << 20] {
            let plan = opened(&files, name, None).unwrap();
            assert_eq!(filled(plan, bytes, false, most).unwrap(), (Kind::Int16, ramp()), "{name} {most}");
        }
    }
}

#[test]
fn scaled_integers_get_the_type_that_holds_them() {
    let mut file = nifti();
    file[112..116].copy_from_slice(&1.0_f32.to_le_bytes());
    file[116..120].copy_from_slice(&(-32000.0_f32).to_le_bytes());
    let files = Files::from([("a.nii", file.clone()), ("b.nii.gz", gzipped(&file))]);
    for name in files.keys() {
        let (plan, kind, voxels) = read(&files, name, false).unwrap();
        assert_eq!((plan.settled(false), kind), (None, Kind::Int32));
        assert_eq!(voxels[..4], (-33000_i32).to_ne_bytes());
        let (_, kind, voxels) = read(&files, name, true).unwrap();
        assert_eq!((kind, &voxels[..4]), (Kind::Float32, &(-33000.0_f32).to_ne_bytes()[..]));
        let remark = "values are scaled by 1 and shifted by -32000: integers where 64 bits hold them";
        assert_eq!(plan.remarks, [remark]);
    }
}

#[test]
fn compressed_voxels_of_other_kinds_are_unpacked() {
    let files = Files::from([
        ("a.mhd", MHD.into()),
        ("a.zraw", zlibbed(&ramp())),
        ("a.nrrd", nrrd("bzip2", &bzipped(&ramp()))),
    ]);
    assert_eq!(read(&files, "a.nrrd", false).unwrap().2, ramp());
    let (plan, _, voxels) = read(&files, "a.mhd", false).unwrap();
    assert_eq!((plan.place.codec, voxels), (Codec::Zlib, ramp()));
    assert_eq!(plan.grid.world_from_index[2], [0.0, 0.0, 2.0, 0.0]);
    assert!(plan.grid.states_spacing && !plan.grid.states_orientation);
}

#[test]
fn damaged_streams_are_refused() {
    let whole = gzipped(&nifti());
    let mut wrong = whole.clone();
    let at = wrong.len() - 8;
    wrong[at] ^= 1;
    let mut length = whole.clone();
    *length.last_mut().unwrap() ^= 1;
    let long = gzipped(&[nifti(), vec![7; 9]].concat());
    let mut packer = Packer::default();
    let mut bomb = packer.pack(&nifti());
    (0..1025).for_each(|_| bomb.extend(packer.pack(&[0; 1 << 20])));
    bomb.extend(packer.end());
    let cases = [
        ("wrong length", length, "a compressed stream that is damaged"),
        ("short", whole[..whole.len() - 9].to_vec(), "a compressed stream that breaks off"),
        ("no check sum", whole[..whole.len() - 1].to_vec(), "a compressed stream that breaks off"),
        ("wrong check sum", wrong, "a compressed stream that is damaged"),
        ("few voxels", gzipped(&nifti()[..390]), "38 bytes of voxels"),
        ("short after the voxels", long[..long.len() - 1].to_vec(), "a compressed stream that breaks off"),
        ("bomb after the voxels", bomb, "over 1073741824 bytes after the voxels"),
        ("empty parts", [gzipped(&nifti()[..390]), gzipped(&[]).repeat(1002)].concat(), "38 bytes of voxels"),
    ];
    for (case, bytes, words) in cases {
        let error = read(&Files::from([("a.nii.gz", bytes)]), "a.nii.gz", false).unwrap_err();
        assert!(error.found.contains(words), "{case}: {error}");
        assert!(["copy the file again", "write the volume again"].contains(&error.mend.as_str()));
    }
}

/// Flips every bit of a file; returns how many files were read. Panics if one has other voxels.
fn read_with_a_flipped_bit(files: &Files, name: &'static str, changed: &'static str) -> usize {
    let mut files = files.clone();
    let mut count = 0;
    for bit in 0..8 * files[changed].len() {
        let flip = |files: &mut Files| files.get_mut(changed).unwrap()[bit / 8] ^= 1 << (bit % 8);
        flip(&mut files);
        if let Ok((_, _, voxels)) = read(&files, name, false) {
            assert_eq!(voxels, ramp(), "bit {bit} of {changed}");
            count += 1;
        }
        flip(&mut files);
    }
    count
}

#[test]
fn no_flipped_bit_of_a_compressed_stream_changes_voxels() {
    let long = [ramp(), b"what follows the voxels".to_vec()].concat();
    let detached = |encoding: &str| [nrrd(encoding, b"").trim_ascii_end(), b"\ndata file: a.raw\n"].concat();
    let nii = Files::from([("a.nii.gz", gzipped(&[nifti(), b"what follows".to_vec()].concat()))]);
    let several = [gzipped(&ramp()[..20]), gzipped(&long[20..]), gzipped(b"more")].concat();
    // Bits that change no voxel: those of a name, a time or a system in the header of gzip, and what pads a byte.
    for (files, name, changed, most) in [
        (nii, "a.nii.gz", "a.nii.gz", 70),
        (Files::from([("a.nhdr", detached("gzip")), ("a.raw", gzipped(&long))]), "a.nhdr", "a.raw", 70),
        (Files::from([("a.nhdr", detached("gzip")), ("a.raw", several)]), "a.nhdr", "a.raw", 350),
        (Files::from([("a.nhdr", detached("bzip2")), ("a.raw", bzipped(&long))]), "a.nhdr", "a.raw", 20),
        (Files::from([("a.mhd", MHD.into()), ("a.zraw", zlibbed(&long))]), "a.mhd", "a.zraw", 20),
    ] {
        let count = read_with_a_flipped_bit(&files, name, changed);
        assert!(count <= most, "{count} files like {changed} of {name} were read");
    }
}

#[test]
fn a_size_that_the_file_does_not_fill_is_refused_before_there_is_room() {
    let mut nifti = nifti();
    for axis in [42, 44, 46] {
        nifti[axis..axis + 2].copy_from_slice(&i16::MAX.to_le_bytes());
    }
    let huge = |file: Vec<u8>| String::from_utf8_lossy(&file).replace("4 3 2", "1048576 1048576 1048576");
    let bzip2 = huge(nrrd("bzip2", b"BZh91AY&SY"));
    let files = Files::from([
        ("a.nii", nifti.clone()),
        ("b.nii.gz", gzipped(&nifti)),
        ("c.nrrd", huge(nrrd("raw", &ramp())).into_bytes()),
        ("d.nrrd", huge(nrrd("text", b"1 2 3")).into_bytes()),
        ("e.nrrd", bzip2.into_bytes()),
    ]);
    for name in files.keys() {
        let error = read(&files, name, false).unwrap_err();
        assert!(error.found.ends_with("bytes of voxels"), "{error}");
    }
}

#[test]
fn text_that_is_no_number_is_refused() {
    let numbers = "10 ".repeat(23);
    let cases = [
        ("1.5", "voxels that are no numbers"),
        ("70000", "a voxel of 70000"),
        ("", "23 numbers"),
        ("1 1", "25 numbers"),
        (&"9".repeat(500), "a word of many letters among the voxels"),
    ];
    for (last, words) in cases {
        let file = nrrd("ascii", format!("{numbers}{last}").as_bytes());
        let error = read(&Files::from([("a.nrrd", file)]), "a.nrrd", false).unwrap_err();
        assert_eq!(error.found, words);
    }
}

#[test]
fn files_outside_the_folder_are_refused() {
    for name in ["../a.raw", "/a.raw", "b/../../a.raw", "C:\\a.raw", "~/a.raw", "a\u{7}.raw", ""] {
        let file = nrrd("raw", b"").len();
        let header = String::from_utf8(nrrd("raw", b"")[..file - 1].to_vec()).unwrap();
        let file = format!("{header}data file: {name}\n");
        let error = refused(opened(&Files::from([("a.nhdr", file.into())]), "a.nhdr", None).unwrap_err());
        assert!(error.found.contains("data file"), "{error}");
    }
}

#[test]
fn a_grid_that_no_volume_can_have_is_refused() {
    let mut far = nifti();
    far[280..284].copy_from_slice(&1e9_f32.to_le_bytes());
    let flat = nrrd("raw", &ramp());
    let flat = String::from_utf8_lossy(&flat).replace("(0.0,0.0,-2.0)", "(0.5,0.75,0)").into_bytes();
    let mhd = MHD.replace("ElementSpacing", "Offset = 0 -2e9 0\nElementSpacing");
    let long = MHD.replace("2\nElementType", "6e8\nElementType");
    let files = Files::from([
        ("a.nii", far),
        ("b.nrrd", flat),
        ("c.mhd", mhd.into()),
        ("d.mhd", long.into()),
        ("a.zraw", zlibbed(&ramp())),
    ]);
    for (name, found, expected) in [
        ("a.nii", "[[-1e+09, 0.125, 0, -10], [0, 0.75, 0, 20], [0, 0, -2, 30]]", "a grid within 1e+09 mm"),
        ("b.nrrd", "[[0.5, 0.125, 0.5, -10], [0, 0.75, 0.75, 20], [0, 0, 0, 30]]", "an invertible affine"),
        ("c.mhd", "[[0.5, 0, 0, 0], [0, 0.75, 0, -2e+09], [0, 0, 2, 0]]", "a grid within 1e+09 mm"),
        ("d.mhd", "[[0.5, 0, 0, 0], [0, 0.75, 0, 0], [0, 0, 6e+08, 0]]", "a grid within 1e+09 mm"),
    ] {
        let error = read(&files, name, false).unwrap_err();
        assert_eq!(error.found, format!("world_from_index of the volume {found}"));
        assert!(error.expected.starts_with(expected), "{error}");
    }
}

#[test]
fn missing_files_are_told_of() {
    let mut pair = nifti();
    pair[344..348].copy_from_slice(b"ni1\0");
    pair[108..112].fill(0);
    let files = Files::from([("a.hdr", pair[..348].to_vec())]);
    let error = read(&files, "a.hdr", false).unwrap_err();
    assert_eq!((error.kind, error.expected.as_str()), (ErrorKind::File, "the voxels of a.hdr"));
    let both = Files::from([("a.hdr", pair[..348].to_vec()), ("a.img.gz", gzipped(&ramp()))]);
    for name in ["a.hdr", "a.img.gz"] {
        assert_eq!(read(&both, name, false).unwrap().2, ramp());
    }
}

#[test]
fn faults_of_headers_are_mended_and_noted() {
    let mut file = nifti();
    file[80..84].fill(0);
    file[84..88].copy_from_slice(&(-3.0_f32).to_le_bytes());
    file[254..256].copy_from_slice(&9_i16.to_le_bytes());
    file[123] = 0;
    let plan = opened(&Files::from([("a.nii", file)]), "a.nii", None).unwrap();
    let expected = [
        "pixdim[1,2,3] should be non-zero and pixdim[1,2,3] should b…",
        "sform_code 9 not valid; setting to 0",
        "the unit of length is not stated: mm assumed",
        "no placement (qform_code = sform_code = 0): centred at the origin, i to the left, like nibabel",
    ];
    assert_eq!(plan.notes, expected);
    assert_eq!(plan.grid.world_from_index[1], [0.0, -3.0, 0.0, 3.0]);
}

fn segments(layers: &str, sizes: &str, directions: &str, voxels: &[u8]) -> Files<'static> {
    let header = format!(
        "NRRD0004\ntype: uint8\ndimension: {}\nsizes: {sizes}\nspace: lps\nspace directions: {directions}\n\
         space origin: (0,0,0)\nencoding: raw\nSegment0_Name:=aorta\nSegment0_LabelValue:=1\nSegment0_Layer:=0\n\
         Segment1_Name:=vein\nSegment1_LabelValue:=2\nSegment1_Layer:={layers}\n\n",
        sizes.split(' ').count()
    );
    Files::from([("a.seg.nrrd", [header.as_bytes(), voxels].concat())])
}

#[test]
fn layers_become_one_label_map() {
    let first = segments("1", "2 2 1 1", "none (1,0,0) (0,1,0) (0,0,1)", &[1, 0, 0, 2]);
    let last = segments("1", "2 1 1 2", "(1,0,0) (0,1,0) (0,0,1) none", &[1, 0, 0, 2]);
    for files in [first, last] {
        let (plan, kind, voxels) = read(&files, "a.seg.nrrd", false).unwrap();
        assert_eq!((kind, voxels), (Kind::Uint8, vec![1, 2]));
        assert_eq!(plan.label_names, [(1, "aorta".into()), (2, "vein".into())]);
        let chosen = opened(&files, "a.seg.nrrd", Some(&[2])).unwrap();
        assert_eq!(filled(chosen, &files["a.seg.nrrd"], false, 8).unwrap().1, [0, 2]);
    }
}

#[test]
fn overlapping_segments_are_refused() {
    let files = segments("1", "2 2 1 1", "none (1,0,0) (0,1,0) (0,0,1)", &[1, 2, 0, 2]);
    let error = read(&files, "a.seg.nrrd", true).unwrap_err();
    assert_eq!(error.kind, ErrorKind::Overlap);
    assert_eq!(error.found, "segments that overlap: 1 aorta and 2 vein in 1 voxels");
    let missing = opened(&files, "a.seg.nrrd", Some(&[3])).unwrap_err();
    assert_eq!(refused(missing).expected, "segments of the file: 1 aorta, 2 vein");
}

#[test]
fn other_files_are_left_to_other_readers() {
    let files = Files::from([("a.txt", b"some text".to_vec()), ("a.nii.bz2", b"BZh9".to_vec())]);
    assert_eq!(opened(&files, "a.txt", None), Err(Stop::Unknown));
    let error = refused(opened(&files, "a.nii.bz2", None).unwrap_err());
    assert_eq!(error.found, "a file compressed with bzip2");
    assert_eq!(format_of("a", b"x\nObjectType=Image\n"), Some(Format::MetaImage));
    assert_eq!(Scaling::NONE, Scaling { slope: 1.0, intercept: 0.0 });
}
