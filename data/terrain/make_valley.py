#!/usr/bin/env python3
"""Writes valley.npy: mountains of 160 × 160 posts, 50 m apart, around a river bed, made of noise with a spectrum of power -2.2 and a seed."""
import pathlib

import numpy as np

SIDE, STEP = 160, 50.0
random = np.random.default_rng(7)
k = np.hypot(*np.meshgrid(np.fft.fftfreq(2 * SIDE), np.fft.fftfreq(2 * SIDE)))
spectrum = np.fft.fft2(random.standard_normal(k.shape)) * np.where(k > 0, np.maximum(k, 1e-9), np.inf) ** -2.2
noise = np.fft.ifft2(spectrum).real[:SIDE, :SIDE]
noise = (noise - noise.mean()) / noise.std()
row, column = np.mgrid[0:SIDE, 0:SIDE] / (SIDE - 1.0)
river = 0.5 + 0.12 * np.sin(5.0 * row)
away = np.abs(column - river)
heights = 300.0 + 1500.0 * (1.0 - np.exp(-(6.0 * away) ** 2 / 2.0)) * (0.55 + 0.30 * noise) + 12.0 * noise
np.save(pathlib.Path(__file__).resolve().parent / "valley.npy", np.maximum(heights, 300.0).astype(np.float32))
