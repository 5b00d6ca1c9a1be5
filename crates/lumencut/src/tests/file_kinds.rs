use std::collections::BTreeSet;

use super::*;

fn found(head: &[u8], name: &str) -> (&'static str, Role, String) {
    let KnownFile { kind, role, words, .. } = kind_of(head, name);
    (kind, role, words)
}

#[test]
fn content_states_the_kind_whatever_the_name() {
    let mut nifti = [0_u8; 352];
    nifti[..4].copy_from_slice(&540_u32.to_be_bytes());
    let mut dicom = [0_u8; 132];
    dicom[128..].copy_from_slice(b"DICM");
    for (head, kind) in [
        (&nifti[..], "nifti"),
        (&dicom[..], "dicom"),
        (&[8, 0, 5, 0, 0x43, 0x53], "dicom"),
        (b"NRRD0005\n", "nrrd"),
        (b"PK\x03\x04", "zip"),
        (b"NDims = 3\r\nObjectType =Image\r\n", "metaimage"),
        (b"<?xml version=\"1.0\"?>\n<VTKFile header_type=\"UInt64\" type = 'PolyData'>", "vtk"),
        (b"\xef\xbb\xbf <VTKFile type=\"ImageData\"><ImageData/>", "vtk image"),
        (b"# vtk DataFile Version 3.0\nt\nASCII\n dataset polydata\n", "vtk"),
        (b"# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_POINTS\n", "vtk image"),
        (b"{\"vtkClass\": \"vtkImageData\"}", "vtk.js image"),
        (b"{\"vtkClass\" : \"vtkPolyData\"}", "vtk.js lines"),
        (b"{\"@schema\": \"\", \"markups\": []}", "markups"),
    ] {
        assert_eq!(found(head, "any.swc").0, kind, "{}", head.escape_ascii());
    }
}

#[test]
fn the_name_decides_where_the_content_does_not() {
    assert_eq!(found(b"1 2 0 0 0 1 -1", "A.SWC"), ("swc", Role::Centerlines, "a .swc file".into()));
    assert_eq!(found(b"{", "a.mrk.json"), ("markups", Role::Centerlines, "a .mrk.json file".into()));
    assert_eq!(found(b"?", "a.hdr.gz"), ("nifti", Role::Volume, "a NIfTI volume".into()));
    assert_eq!(found(b"?", "a.mhd"), ("metaimage", Role::Volume, "a MetaImage volume".into()));
    assert_eq!(found(b"PK\x03\x04", "a.npz"), ("unknown", Role::Other, "a file of unknown format".into()));
    for name in ["readme.txt", "a.npy", "swc", "a.img"] {
        assert_eq!(found(b"hello", name).1, Role::Other, "{name}");
    }
    assert_eq!(found(b"", "a.vtp"), ("empty", Role::Other, "an empty file".into()));
    assert_eq!((folder().kind, folder().role), ("folder", Role::Volume));
}

#[test]
fn every_beginning_of_a_file_is_accepted() {
    let text = b"<VTKFile type=\"PolyData\"> type= {\"vtkClass\" : \"vtkPolyData\"";
    for length in 0..text.len() {
        kind_of(&text[..length], "");
        kind_of(&text[text.len() - length..], "");
    }
}

#[test]
fn names_and_extensions_stand_once() {
    let mut seen = BTreeSet::new();
    for kind in FILE_KINDS {
        assert!(seen.insert(kind.name), "{}", kind.name);
        for extension in kind.extensions {
            assert!(seen.insert(extension) && extension.starts_with('.'), "{extension}");
        }
        assert!(kind.written.iter().all(|extension| kind.extensions.contains(extension)), "{}", kind.name);
        assert!(!kind.words.is_empty() || !kind.extensions.is_empty(), "{}", kind.name);
    }
}

#[test]
fn messages_name_every_kind_that_is_read() {
    assert_eq!(
        volume_files(),
        "a DICOM folder, file or zip archive, NIfTI (.nii, .nii.gz, .hdr + .img), NRRD (.nrrd, .nhdr) or \
         MetaImage (.mha, .mhd)"
    );
    assert_eq!(centerline_files(), "centerlines (.vtp, .vtk, .mrk.json, .fcsv, .pth, .swc, .tre, .csv)");
}

#[test]
fn extensions_are_listed_in_words() {
    assert_eq!(written_volumes(), ".nrrd, .nii or .nii.gz");
    assert_eq!(written_centerlines(), ".vtp, .vtk, .mrk.json, .csv or .swc");
    assert_eq!(saved_by_the_page(), ["vtp", "mrk.json"]);
}
