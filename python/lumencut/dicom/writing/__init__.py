"""DICOM objects that belong to the study of a scan: pictures, values, reports and numbers."""
