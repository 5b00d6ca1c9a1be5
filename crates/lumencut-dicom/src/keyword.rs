//! The attributes that this crate uses and callers must read.

macro_rules! keywords {
    ($($(#[$comment:meta])* $keyword:ident),+ $(,)?) => {
        /// An attribute, named by its keyword in the standard (PS3.6), which defines its meaning.
        #[allow(missing_docs)]
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum Keyword { $($(#[$comment])* $keyword),+ }

        impl Keyword {
            /// All attributes.
            pub const ALL: &[Self] = &[$(Self::$keyword),+];

            /// The keyword.
            pub fn name(self) -> &'static str {
                match self { $(Self::$keyword => stringify!($keyword)),+ }
            }
        }
    };
}

keywords! {
    /// Identifier of the image; images with the same one are copies.
    SOPInstanceUID,
    StudyInstanceUID,
    /// Identifier of a coordinate space that several series may have in common.
    FrameOfReferenceUID,
    PatientID,
    IssuerOfPatientID,
    /// Name of the patient; never shown.
    PatientName,
    /// Birth date of the patient; never shown.
    PatientBirthDate,
    SeriesInstanceUID,
    SeriesNumber,
    SeriesDescription,
    Modality,
    ImageType,
    FrameType,
    NumberOfFrames,
    Rows,
    Columns,
    SamplesPerPixel,
    PhotometricInterpretation,
    BitsAllocated,
    BitsStored,
    /// Highest bit that is used.
    HighBit,
    PixelRepresentation,
    /// Stored number of pixels outside the scan.
    PixelPaddingValue,
    /// Look-up table from stored numbers to values; callers pass its number of items.
    ModalityLUTSequence,
    RescaleSlope,
    RescaleIntercept,
    LossyImageCompression,
    /// Distance between rows, then between columns (mm).
    PixelSpacing,
    /// Centre of the first pixel (mm, LPS).
    ImagePositionPatient,
    ImageOrientationPatient,
    SliceThickness,
    /// Slice distance (mm) as stated.
    SpacingBetweenSlices,
    /// Gantry tilt (degrees).
    GantryDetectorTilt,
    TemporalPositionIdentifier,
    TemporalPositionIndex,
    /// Phase of the heart (percent).
    NominalPercentageOfCardiacPhase,
    /// Phase of the heart (ms after the R wave).
    NominalCardiacTriggerDelayTime,
    /// Time since the trigger (ms).
    TriggerTime,
    ContrastBolusAgentPhase,
    EchoNumbers,
    /// Echo time (ms).
    EchoTime,
    /// Echo time of a frame (ms).
    EffectiveEchoTime,
    StackID,
    ConvolutionKernel,
    AcquisitionNumber,
    FrameAcquisitionNumber,
    AcquisitionTime,
    FrameAcquisitionDateTime,
    /// Time at which the image was created.
    ContentTime,
}

impl Keyword {
    /// The attribute with this keyword; None if this crate does not use it.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|keyword| keyword.name() == name)
    }

    /// Functional groups of enhanced multi-frame images that may contain the attribute (PS3.3 C.7.6.16), in
    /// order. Empty for attributes at the top level.
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

    /// Whether the values are floating-point numbers, which JSON may write without a decimal point.
    pub fn is_float(self) -> bool {
        matches!(
            self,
            Self::NominalPercentageOfCardiacPhase
                | Self::NominalCardiacTriggerDelayTime
                | Self::EffectiveEchoTime
        )
    }
}
