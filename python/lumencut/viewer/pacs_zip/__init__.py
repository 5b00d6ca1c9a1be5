"""The output of "Save for PACS" of the viewer: pictures, report and numbers as DICOM, in one zip archive."""
