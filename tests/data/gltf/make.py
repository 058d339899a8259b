#!/usr/bin/env python3
"""Writes the glTF files below this folder, and beside each what a reader has to make of it (.expected.json): triangles in world space.

The expected places are computed here from the same numbers that go into the files; nothing is read back. judge.mjs tells whether another
loader reads the same out of them.
"""
import pathlib

import array_cases
import common_cases
import document
import look_cases
import place_cases

HERE = pathlib.Path(__file__).resolve().parent
for name, module in (("common", common_cases), ("places", place_cases), ("arrays", array_cases), ("looks", look_cases)):
    document.FOLDER = HERE / name
    for case in module.CASES:
        case()
