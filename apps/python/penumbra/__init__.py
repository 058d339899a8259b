"""Exact visibility of area lights, shadow solids and soft-shadow pictures, on NumPy arrays.

Points are doubles, lengths are scene units. Long calls use all cores, run without Python's lock, and stop at Ctrl-C.
"""
from ._penumbra import (Camera, Cancelled, DiskLight, DistantLight, Light, MeshError, RectangleLight, Scene, SceneError,
                        __version__, classify, level, penumbra, render, silhouettes, sun_light, sun_position, umbra)

__all__ = ["Camera", "Cancelled", "DiskLight", "DistantLight", "Light", "MeshError", "RectangleLight", "Scene", "SceneError",
           "__version__", "classify", "level", "penumbra", "render", "silhouettes",
           "sun_light", "sun_position", "umbra"]
