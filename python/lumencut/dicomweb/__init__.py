"""A PACS over DICOMweb: what it has, what is fetched of it, and what is sent to it."""
