"""What a picture is made of: volumes, vessels and trees, cameras, windows, settings."""
