/** Tags and value representations (PS3.6) of the attributes that `lumencut-dicom` can ask for. */

export type Vr =
  | 'CS'
  | 'DA'
  | 'DS'
  | 'DT'
  | 'FD'
  | 'FL'
  | 'IS'
  | 'LO'
  | 'PN'
  | 'SH'
  | 'SQ'
  | 'TM'
  | 'UI'
  | 'UL'
  | 'US'
  | 'US or SS';

interface Attribute {
  /** Group and element as eight hexadecimal digits, for dicom-parser. */
  readonly tag: string;
  readonly vr: Vr;
}

const TABLE: readonly (readonly [string, string, Vr])[] = [
  ['SOPInstanceUID', '00080018', 'UI'],
  ['StudyInstanceUID', '0020000d', 'UI'],
  ['FrameOfReferenceUID', '00200052', 'UI'],
  ['PatientID', '00100020', 'LO'],
  ['IssuerOfPatientID', '00100021', 'LO'],
  ['PatientName', '00100010', 'PN'],
  ['PatientBirthDate', '00100030', 'DA'],
  ['SeriesInstanceUID', '0020000e', 'UI'],
  ['SeriesNumber', '00200011', 'IS'],
  ['SeriesDescription', '0008103e', 'LO'],
  ['Modality', '00080060', 'CS'],
  ['ImageType', '00080008', 'CS'],
  ['FrameType', '00089007', 'CS'],
  ['NumberOfFrames', '00280008', 'IS'],
  ['Rows', '00280010', 'US'],
  ['Columns', '00280011', 'US'],
  ['SamplesPerPixel', '00280002', 'US'],
  ['PhotometricInterpretation', '00280004', 'CS'],
  ['BitsAllocated', '00280100', 'US'],
  ['BitsStored', '00280101', 'US'],
  ['HighBit', '00280102', 'US'],
  ['PixelRepresentation', '00280103', 'US'],
  ['PixelPaddingValue', '00280120', 'US or SS'],
  ['ModalityLUTSequence', '00283000', 'SQ'],
  ['RescaleSlope', '00281053', 'DS'],
  ['RescaleIntercept', '00281052', 'DS'],
  ['LossyImageCompression', '00282110', 'CS'],
  ['PixelSpacing', '00280030', 'DS'],
  ['ImagePositionPatient', '00200032', 'DS'],
  ['ImageOrientationPatient', '00200037', 'DS'],
  ['SliceThickness', '00180050', 'DS'],
  ['SpacingBetweenSlices', '00180088', 'DS'],
  ['GantryDetectorTilt', '00181120', 'DS'],
  ['TemporalPositionIdentifier', '00200100', 'IS'],
  ['TemporalPositionIndex', '00209128', 'UL'],
  ['NominalPercentageOfCardiacPhase', '00209241', 'FL'],
  ['NominalCardiacTriggerDelayTime', '00209153', 'FD'],
  ['TriggerTime', '00181060', 'DS'],
  ['ContrastBolusAgentPhase', '00189344', 'CS'],
  ['EchoNumbers', '00180086', 'IS'],
  ['EchoTime', '00180081', 'DS'],
  ['EffectiveEchoTime', '00189082', 'FD'],
  ['StackID', '00209056', 'SH'],
  ['ConvolutionKernel', '00181210', 'SH'],
  ['AcquisitionNumber', '00200012', 'IS'],
  ['FrameAcquisitionNumber', '00209156', 'US'],
  ['AcquisitionTime', '00080032', 'TM'],
  ['FrameAcquisitionDateTime', '00189074', 'DT'],
  ['ContentTime', '00080033', 'TM'],
  ['PlanePositionSequence', '00209113', 'SQ'],
  ['PlaneOrientationSequence', '00209116', 'SQ'],
  ['PixelMeasuresSequence', '00289110', 'SQ'],
  ['PixelValueTransformationSequence', '00289145', 'SQ'],
  ['CTAcquisitionDetailsSequence', '00189304', 'SQ'],
  ['FrameContentSequence', '00209111', 'SQ'],
  ['CardiacSynchronizationSequence', '00189118', 'SQ'],
  ['MREchoSequence', '00189114', 'SQ'],
  ['CTReconstructionSequence', '00189314', 'SQ'],
  ['ContrastBolusUsageSequence', '00189341', 'SQ'],
  ['CTImageFrameTypeSequence', '00189329', 'SQ'],
  ['MRImageFrameTypeSequence', '00189226', 'SQ'],
  ['XRay3DFrameTypeSequence', '00189504', 'SQ'],
];

const BY_KEYWORD = new Map(TABLE.map(([keyword, tag, vr]) => [keyword, { tag: `x${tag}`, vr }] as const));

export function attribute(keyword: string): Attribute | null {
  return BY_KEYWORD.get(keyword) ?? null;
}

export const TAGS = {
  characterSet: 'x00080005',
  sopClass: 'x00080016',
  study: 'x0020000d',
  mediaSopClass: 'x00020002',
  transferSyntax: 'x00020010',
  shared: 'x52009229',
  perFrame: 'x52009230',
} as const;
