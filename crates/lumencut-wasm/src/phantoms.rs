//! Opens phantoms by name.

use lumencut::error::{Error, ErrorKind, Mend};
use lumencut_phantom::Phantom;

use lumencut::study::failure::{Failure, Result};
use lumencut::study::held_volume::HeldVolume;
use lumencut::study::open_study::Study;
use lumencut::study::voxels::Stored;

/// Opens the phantom `name`, see [`phantom`], and closes the current study.
pub fn open(study: &mut Study, name: &str, scale: f64) -> Result<()> {
    study.close();
    let Phantom { voxels, size, world_from_index, tree, vessel_names, .. } = phantom(name, scale)?;
    let (stored, scan) = (Stored::I16(voxels), Default::default());
    let held = HeldVolume { stored, size, world_from_index, key: Default::default(), scan };
    study.open(held, tree, vessel_names)
}

/// The phantom `name`. Benchmark phantoms have `scale` times as many voxels along each axis. Fails with an error of
/// kind `settings` for an unknown name; of kind `volume` if there is not enough memory.
pub fn phantom(name: &str, scale: f64) -> Result<Phantom> {
    let made = match name {
        "aorta" => lumencut_phantom::aorta(0, scale),
        "cervical" => lumencut_phantom::cervical(0, scale),
        "stenosis" => lumencut_phantom::stenosis(50.0),
        "y_junction" => lumencut_phantom::y_junction(),
        other => {
            let expected = "aorta, cervical, stenosis or y_junction";
            return Err(Failure::of_message("name of the phantom", &other, expected));
        }
    };
    let with_mend = |error: Error| {
        if error.kind == ErrorKind::Volume {
            error.mend("close other pages").mended_by(Mend::EverySecond)
        } else {
            error
        }
    };
    Ok(made.map_err(with_mend)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_phantom_can_have_fewer_voxels() {
        let mut study = Study::default();
        open(&mut study, "aorta", 0.1).expect("a phantom");
        assert_eq!(study.content.held.as_ref().map(|held| held.size), Some([51, 51, 26]));
        assert_eq!(open(&mut study, "aorta", 0.0).expect_err("no scale").kind, "settings");
    }

    #[test]
    fn a_name_that_no_phantom_has_is_refused() {
        assert_eq!(phantom("heart", 1.0).expect_err("no phantom").subject, "name of the phantom");
    }
}
