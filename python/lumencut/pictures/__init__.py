"""Rendered pictures: the renderer and its frames, labels, recipes, turntables and films."""
