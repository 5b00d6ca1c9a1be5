"""Curved Surface Reformation: the lumen of all vessels of an angiography in one freely rotatable view."""
