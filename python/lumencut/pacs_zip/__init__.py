"""What "Save for PACS" of the viewer gives: pictures, report and numbers as DICOM, in one zip archive."""
