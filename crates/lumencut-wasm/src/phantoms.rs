//! Phantoms by their names.

use lumencut::error::{Error, ErrorKind};
use lumencut_phantom::Phantom;

use crate::failure::{Failure, Result};
use crate::voxels::COARSER;

/// The phantom of this name, in `scale` times as many voxels along each axis where it is one that has scales.
///
/// # Errors
/// `settings` for another name, `volume` where the browser has not enough memory.
pub fn phantom(name: &str, scale: f64) -> Result<Phantom> {
    let made = match name {
        "aorta" => lumencut_phantom::aorta(0, scale),
        "runoff" => lumencut_phantom::runoff(0, scale),
        "cervical" => lumencut_phantom::cervical(0, scale),
        "stenosis" => lumencut_phantom::stenosis(50.0),
        "y_junction" => lumencut_phantom::y_junction(),
        other => {
            let expected = "aorta, runoff, cervical, stenosis or y_junction";
            return Err(Failure::of_message("name of the phantom", &other, expected));
        }
    };
    let with_mend = |error: Error| if error.kind == ErrorKind::Volume { error.mend(COARSER) } else { error };
    Ok(made.map_err(with_mend)?)
}
