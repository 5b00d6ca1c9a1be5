"""The viewer's server: the built page and the data of one scene, only for browsers of this machine."""
