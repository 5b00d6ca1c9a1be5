//! Remedies for errors that a host (Python, command line, page) can apply or put into its own words.

use std::fmt;

/// A remedy for an [`Error`](crate::error::Error). The Python package, the command line and the page each
/// word it: as arguments, options or buttons. The words of [`fmt::Display`] are for Rust programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Mend {
    /// Trace straight across a stretch between two points that does not look like lumen.
    Bridge,
    /// Take every second voxel along each axis, which needs an eighth of the memory.
    EverySecond,
    /// Compute on the CPU.
    Cpu,
    /// Set the windows, which the data do not contain.
    Windows,
    /// Compare the values of a mask with a threshold.
    Threshold,
    /// Ask for fewer pixels: larger ones, or a narrower picture.
    FewerPixels,
    /// Inspect the vessels that were found but are doubtful.
    Doubtful,
    /// Also search for thinner vessels.
    SmallerRadius,
    /// Compare scans of two patients.
    OtherPatient,
}

impl Mend {
    /// Every remedy of this crate.
    pub const ALL: [Self; 9] = [
        Self::Bridge,
        Self::EverySecond,
        Self::Cpu,
        Self::Windows,
        Self::Threshold,
        Self::FewerPixels,
        Self::Doubtful,
        Self::SmallerRadius,
        Self::OtherPatient,
    ];

    /// The name of the remedy, the same in Python, on the command line and on the page.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Bridge => "bridge",
            Self::EverySecond => "every_second",
            Self::Cpu => "cpu",
            Self::Windows => "windows",
            Self::Threshold => "threshold",
            Self::FewerPixels => "fewer_pixels",
            Self::Doubtful => "doubtful",
            Self::SmallerRadius => "smaller_radius",
            Self::OtherPatient => "other_patient",
        }
    }
}

impl fmt::Display for Mend {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Bridge => "allow a bridge across the occlusion",
            Self::EverySecond => "take every second voxel along each axis (an eighth of the memory)",
            Self::Cpu => "compute with the device 'cpu'",
            Self::Windows => "set the windows, which the data do not contain",
            Self::Threshold => "compare the values with a threshold first",
            Self::FewerPixels => "choose larger pixels or a smaller width",
            Self::Doubtful => "inspect the doubtful vessels",
            Self::SmallerRadius => "choose a smaller radius",
            Self::OtherPatient => "accept scans of two patients",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::{Error, ErrorKind};

    #[test]
    fn no_two_mends_share_a_name() {
        let names: Vec<&str> = Mend::ALL.into_iter().map(Mend::name).collect();
        assert!(names.iter().enumerate().all(|(n, name)| !names[..n].contains(name)), "{names:?}");
    }

    #[test]
    fn it_stands_behind_the_advice() {
        let error = Error::new(ErrorKind::Device, "device", "a", "b");
        let line = |error: Error| error.to_string();
        assert_eq!(line(error.clone()), "device: found a; expected b");
        assert_eq!(line(error.clone().mend("c")), "device: found a; expected b; c");
        let mended = error.mended_by(Mend::Cpu);
        assert_eq!(line(mended.clone()), "device: found a; expected b; compute with the device 'cpu'");
        assert_eq!(
            line(mended.mend("c")),
            "device: found a; expected b; c, or compute with the device 'cpu'"
        );
    }
}
