"""Reads every file that lists of fields name, with meshio: python3 read_fields.py fields.pvd [tools.pvd].

Prints a line for each array: file, "point" or "cell", name, components, entries, sum of magnitudes.
"""
import pathlib
import sys
import xml.etree.ElementTree

import meshio
import numpy


def show(file, where, name, values):
    components = values.shape[1] if values.ndim > 1 else 1
    total = 0.0
    for value in numpy.abs(values).ravel():  # in the order that a C++ loop adds in
        total += float(value)
    print(file, where, name, components, len(values), f"{total:.9g}", sep="\t")


for argument in sys.argv[1:]:
    series = pathlib.Path(argument)
    for entry in xml.etree.ElementTree.parse(series).iter("DataSet"):
        file = entry.get("file")
        mesh = meshio.read(series.parent / file)
        show(file, "place", "", mesh.points)
        for name, values in mesh.point_data.items():
            show(file, "point", name, values)
        for name, blocks in mesh.cell_data.items():
            show(file, "cell", name, numpy.concatenate(blocks))
