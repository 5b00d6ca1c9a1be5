//! The attributes used in judgements, which hosts read.

macro_rules! keywords {
    ($($(#[$comment:meta])+ $keyword:ident),+ $(,)?) => {
        /// An attribute, by its keyword in the standard (PS3.6).
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum Keyword { $($(#[$comment])+ $keyword),+ }

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
    /// Study.
    StudyInstanceUID,
    /// Common space of several series.
    FrameOfReferenceUID,
    /// Patient identifier.
    PatientID,
    /// Issuer of the patient identifier.
    IssuerOfPatientID,
    /// Patient name; never shown.
    PatientName,
    /// Birth date; never shown.
    PatientBirthDate,
    /// Series.
    SeriesInstanceUID,
    /// Number of the series.
    SeriesNumber,
    /// Description of the series.
    SeriesDescription,
    /// Modality.
    Modality,
    /// Image type, such as localiser.
    ImageType,
    /// Image type of a frame.
    FrameType,
    /// Number of frames.
    NumberOfFrames,
    /// Pixels per column.
    Rows,
    /// Pixels per row.
    Columns,
    /// Numbers per pixel.
    SamplesPerPixel,
    /// Meaning of pixel values.
    PhotometricInterpretation,
    /// Bits per stored number.
    BitsAllocated,
    /// Used bits.
    BitsStored,
    /// Highest used bit.
    HighBit,
    /// Whether stored numbers are signed.
    PixelRepresentation,
    /// Stored number outside the scan.
    PixelPaddingValue,
    /// Look-up table from stored numbers to values, passed as its number of items.
    ModalityLUTSequence,
    /// Factor from stored numbers to values.
    RescaleSlope,
    /// Offset from stored numbers to values.
    RescaleIntercept,
    /// Whether compression was lossy.
    LossyImageCompression,
    /// Distance between rows, then between columns (mm).
    PixelSpacing,
    /// Centre of the first pixel (mm, LPS).
    ImagePositionPatient,
    /// Directions of a row and a column.
    ImageOrientationPatient,
    /// Slice thickness (mm).
    SliceThickness,
    /// Stated slice distance (mm).
    SpacingBetweenSlices,
    /// Gantry tilt (degrees).
    GantryDetectorTilt,
    /// Phase number.
    TemporalPositionIdentifier,
    /// Phase number of a frame.
    TemporalPositionIndex,
    /// Cardiac phase (percent).
    NominalPercentageOfCardiacPhase,
    /// Cardiac phase (ms after the R wave).
    NominalCardiacTriggerDelayTime,
    /// Time since the trigger (ms).
    TriggerTime,
    /// Contrast phase.
    ContrastBolusAgentPhase,
    /// Echo number.
    EchoNumbers,
    /// Echo time (ms).
    EchoTime,
    /// Echo time of a frame (ms).
    EffectiveEchoTime,
    /// Stack of a frame.
    StackID,
    /// Reconstruction kernel.
    ConvolutionKernel,
    /// Acquisition number.
    AcquisitionNumber,
    /// Acquisition number of a frame.
    FrameAcquisitionNumber,
    /// Acquisition time.
    AcquisitionTime,
    /// Acquisition time of a frame.
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
