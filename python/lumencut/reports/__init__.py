"""Reports of measured vessels as HTML and PDF, with the pictures of their sections."""
