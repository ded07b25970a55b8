"""The slider in a system: a controller holds its velocity under a changing load."""
