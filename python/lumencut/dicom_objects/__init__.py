"""DICOM objects of the study of a scan: pictures, values, reports and numbers."""
