"""DICOM: reading of series, writing of objects, and PACS over DICOMweb."""
