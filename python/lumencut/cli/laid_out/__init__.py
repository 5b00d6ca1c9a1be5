"""The commands that lay vessels out as images: one module for each reformation, and the table of all."""
