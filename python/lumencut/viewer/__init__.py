"""The viewer's server: the built page and the data of one scene, for a browser of this machine alone."""
