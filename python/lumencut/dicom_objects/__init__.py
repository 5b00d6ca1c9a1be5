"""What Lumencut writes as DICOM, so that it stands beside the scan: pictures, values, reports and numbers."""
