"""OME-Zarr: scans at several resolutions, in chunks (OME-NGFF 0.4 and 0.5; Zarr 2 and 3)."""
