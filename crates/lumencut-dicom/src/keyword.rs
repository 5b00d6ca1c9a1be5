//! The attributes that a series is judged by: what a reader of headers is to look for.

/// Declares the attributes: a comment and the keyword of each.
macro_rules! keywords {
    ($($(#[$comment:meta])+ $keyword:ident),+ $(,)?) => {
        /// An attribute, by its keyword in the standard (PS3.6).
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum Keyword { $($(#[$comment])+ $keyword),+ }

        impl Keyword {
            /// All of them.
            pub const ALL: &[Self] = &[$(Self::$keyword),+];

            /// The keyword as a text.
            pub fn name(self) -> &'static str {
                match self { $(Self::$keyword => stringify!($keyword)),+ }
            }
        }
    };
}

keywords! {
    /// The identifier of the instance: two files with one are copies.
    SOPInstanceUID,
    /// Which study the image belongs to.
    StudyInstanceUID,
    /// The space in which positions of several series agree.
    FrameOfReferenceUID,
    /// The identifier of the patient.
    PatientID,
    /// Who gave that identifier.
    IssuerOfPatientID,
    /// The name of the patient; no message shows it.
    PatientName,
    /// When the patient was born; no message shows it.
    PatientBirthDate,
    /// Which series the image belongs to.
    SeriesInstanceUID,
    /// The number of the series.
    SeriesNumber,
    /// What the series is called.
    SeriesDescription,
    /// What made the images.
    Modality,
    /// What kind of image it is, such as a localiser.
    ImageType,
    /// The same of one frame.
    FrameType,
    /// How many frames the file has.
    NumberOfFrames,
    /// Pixels in a column.
    Rows,
    /// Pixels in a row.
    Columns,
    /// Numbers in a pixel.
    SamplesPerPixel,
    /// How numbers are shown.
    PhotometricInterpretation,
    /// Bits that a stored number takes.
    BitsAllocated,
    /// Bits of them that are used.
    BitsStored,
    /// The place of the highest of them.
    HighBit,
    /// Whether stored numbers have a sign.
    PixelRepresentation,
    /// The stored number of pixels outside the scan.
    PixelPaddingValue,
    /// A table from stored numbers to values; passed as the number of its items.
    ModalityLUTSequence,
    /// From stored numbers to values: the factor.
    RescaleSlope,
    /// From stored numbers to values: what is added.
    RescaleIntercept,
    /// Whether the image was compressed with loss.
    LossyImageCompression,
    /// Distance between rows, then between columns (mm).
    PixelSpacing,
    /// Where the middle of the first pixel lies (mm, LPS).
    ImagePositionPatient,
    /// Directions of a row and of a column.
    ImageOrientationPatient,
    /// How thick the slice is (mm).
    SliceThickness,
    /// How far slices are apart, as stated (mm).
    SpacingBetweenSlices,
    /// The tilt of the gantry (degrees).
    GantryDetectorTilt,
    /// The phase, by its number.
    TemporalPositionIdentifier,
    /// The phase of a frame, by its number.
    TemporalPositionIndex,
    /// The phase of the heart (percent).
    NominalPercentageOfCardiacPhase,
    /// The phase of the heart (ms after the R wave).
    NominalCardiacTriggerDelayTime,
    /// Time since the trigger (ms).
    TriggerTime,
    /// The phase of the contrast medium.
    ContrastBolusAgentPhase,
    /// Which echo it is.
    EchoNumbers,
    /// The time of the echo (ms).
    EchoTime,
    /// The time of the echo of a frame (ms).
    EffectiveEchoTime,
    /// Which stack a frame belongs to.
    StackID,
    /// The kernel of the reconstruction.
    ConvolutionKernel,
    /// The acquisition, by its number.
    AcquisitionNumber,
    /// The acquisition of a frame, by its number.
    FrameAcquisitionNumber,
    /// When it was acquired.
    AcquisitionTime,
    /// When a frame was acquired.
    FrameAcquisitionDateTime,
    /// When the image was made.
    ContentTime,
}

impl Keyword {
    /// The attribute of a keyword, none for those that nothing is judged by.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|keyword| keyword.name() == name)
    }

    /// The functional groups in which an enhanced multi-frame image keeps it for single frames or for all
    /// (PS3.3 C.7.6.16), the first that has it; none for those that stand at the top level alone.
    pub fn groups(self) -> &'static [&'static str] {
        match self {
            Self::ImagePositionPatient => &["PlanePositionSequence"],
            Self::ImageOrientationPatient => &["PlaneOrientationSequence"],
            Self::PixelSpacing | Self::SliceThickness | Self::SpacingBetweenSlices => {
                &["PixelMeasuresSequence"]
            }
            Self::RescaleSlope | Self::RescaleIntercept => &["PixelValueTransformationSequence"],
            Self::GantryDetectorTilt => &["CTAcquisitionDetailsSequence"],
            Self::StackID
            | Self::TemporalPositionIndex
            | Self::FrameAcquisitionNumber
            | Self::FrameAcquisitionDateTime => &["FrameContentSequence"],
            Self::NominalPercentageOfCardiacPhase | Self::NominalCardiacTriggerDelayTime => {
                &["CardiacSynchronizationSequence"]
            }
            Self::EffectiveEchoTime => &["MREchoSequence"],
            Self::ConvolutionKernel => &["CTReconstructionSequence"],
            Self::ContrastBolusAgentPhase => &["ContrastBolusUsageSequence"],
            Self::FrameType => {
                &["CTImageFrameTypeSequence", "MRImageFrameTypeSequence", "XRay3DFrameTypeSequence"]
            }
            _ => &[],
        }
    }

    /// Whether its values are floating-point numbers, which JSON may write without their point.
    pub fn is_float(self) -> bool {
        matches!(
            self,
            Self::NominalPercentageOfCardiacPhase
                | Self::NominalCardiacTriggerDelayTime
                | Self::EffectiveEchoTime
        )
    }
}
