"""A PACS over DICOMweb: list, fetch and send."""
