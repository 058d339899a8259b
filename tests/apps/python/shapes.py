"""Meshes and closed forms that the tests share. Nothing here comes from the module."""
import math

import numpy as np


def plate(half=1.0, y=1.0, edge_at_0=False):
    """A horizontal square plate; with edge_at_0 it fills x <= 0 only."""
    high = 0.0 if edge_at_0 else half
    V = np.array([[-half, y, -half], [high, y, -half], [high, y, half], [-half, y, half]])
    return V, np.array([[0, 2, 1], [0, 3, 2]])


def box(center=(0.0, 1.0, 0.0), half=0.5):
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
    F = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4],
         [1, 5, 7], [1, 7, 3]]
    return np.asarray(center) + half * corners, np.array(F)


def sphere(center, radius, rings=64, around=128):
    """Vertices on the sphere. Its silhouette lies within radius * (1 - cos(pi / rings)) of the sphere's."""
    V = [(0.0, radius, 0.0)]
    for i in range(1, rings):
        t = math.pi * i / rings
        for j in range(around):
            p = 2 * math.pi * j / around
            V.append((radius * math.sin(t) * math.cos(p), radius * math.cos(t), radius * math.sin(t) * math.sin(p)))
    V.append((0.0, -radius, 0.0))
    F = []
    for j in range(around):
        k = (j + 1) % around
        F.append((0, 1 + k, 1 + j))
        F.append((len(V) - 1, len(V) - 1 - around + j, len(V) - 1 - around + k))
        for i in range(rings - 2):
            a, b, c, d = 1 + i * around + j, 1 + i * around + k, 1 + (i + 1) * around + j, 1 + (i + 1) * around + k
            F += [(a, b, d), (a, d, c)]
    return np.asarray(center) + np.array(V), np.array(F)


def part_of_disk(d):
    """The part of a unit disk with x > d."""
    d = np.clip(d, -1.0, 1.0)
    return (np.arccos(d) - d * np.sqrt(1.0 - d * d)) / math.pi


def half_plane_fraction(x, edge_height=1.0, light_height=2.0, radius=0.5):
    """What a point (x, 0, .) sees of a disk over x = 0 that shines down, past a plate that fills x <= 0 at edge_height: the
    edge projects onto the light's plane at x + (0 - x) * light_height / edge_height."""
    return part_of_disk((x - x * light_height / edge_height) / radius)
