//! The attributes used in judgements, which hosts read.

macro_rules! keywords {
    ($($(#[$comment:meta])* $keyword:ident),+ $(,)?) => {
        /// An attribute, by its keyword in the standard (PS3.6), which defines its meaning.
        #[allow(missing_docs)]
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum Keyword { $($(#[$comment])* $keyword),+ }

        impl Keyword {
            /// All attributes.
            pub const ALL: &[Self] = &[$(Self::$keyword),+];

            /// The keyword as text.
            pub fn name(self) -> &'static str {
                match self { $(Self::$keyword => stringify!($keyword)),+ }
            }
        }
    };
}

keywords! {
    /// Instance identifier; equal ones are copies.
    SOPInstanceUID,
    StudyInstanceUID,
    /// Common space of several series.
    FrameOfReferenceUID,
    PatientID,
    IssuerOfPatientID,
    /// Patient name; never shown.
    PatientName,
    /// Birth date; never shown.
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
    /// Highest used bit.
    HighBit,
    PixelRepresentation,
    /// Stored number outside the scan.
    PixelPaddingValue,
    /// Look-up table from stored numbers to values, passed as its number of items.
    ModalityLUTSequence,
    RescaleSlope,
    RescaleIntercept,
    LossyImageCompression,
    /// Distance between rows, then between columns (mm).
    PixelSpacing,
    /// Centre of the first pixel (mm, LPS).
    ImagePositionPatient,
    ImageOrientationPatient,
    /// Slice thickness (mm).
    SliceThickness,
    /// Stated slice distance (mm).
    SpacingBetweenSlices,
    /// Gantry tilt (degrees).
    GantryDetectorTilt,
    TemporalPositionIdentifier,
    TemporalPositionIndex,
    /// Cardiac phase (percent).
    NominalPercentageOfCardiacPhase,
    /// Cardiac phase (ms after the R wave).
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
    /// Creation time of the image.
    ContentTime,
}

impl Keyword {
    /// The attribute of a keyword; None if unused.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|keyword| keyword.name() == name)
    }

    /// Functional groups of enhanced multi-frame images that may have it (PS3.3 C.7.6.16), in order; empty
    /// for top-level attributes.
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

    /// Whether values are floating-point, which JSON may write without a decimal point.
    pub fn is_float(self) -> bool {
        matches!(
            self,
            Self::NominalPercentageOfCardiacPhase
                | Self::NominalCardiacTriggerDelayTime
                | Self::EffectiveEchoTime
        )
    }
}
