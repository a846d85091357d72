"""Arrays with named dimensions: an xarray.Dataset where xarray is installed, else a small stand-in of numpy alone."""

from typing import NamedTuple

import numpy

try:
    import xarray
except ImportError:
    xarray = None


class Variable(NamedTuple):
    """As much of xarray.DataArray as both have in common."""

    dims: tuple
    values: numpy.ndarray
    attrs: dict


class Table:
    """As much of xarray.Dataset as reading needs: table["structure/deflection"].values, .dims, .attrs, table.sizes."""

    def __init__(self, columns, coordinates):
        self.data_vars = {name: Variable(*column) for name, column in columns.items()}
        self.coords = {name: Variable(*column) for name, column in coordinates.items()}
        self.sizes = {}
        for variable in {**self.data_vars, **self.coords}.values():
            self.sizes.update(zip(variable.dims, variable.values.shape))

    def __getitem__(self, name):
        return self.coords[name] if name in self.coords else self.data_vars[name]

    def __contains__(self, name):
        return name in self.coords or name in self.data_vars

    def __iter__(self):
        return iter(self.data_vars)


def make_dataset(columns, coordinates):
    """name -> (dimensions, values, attributes), twice. ValueError where the lengths along a dimension differ."""
    lengths = {}
    for name, (dimensions, values, _) in {**columns, **coordinates}.items():
        for dimension, length in zip(dimensions, values.shape):
            if lengths.setdefault(dimension, length) != length:
                raise ValueError(f"{name} has {length} values along {dimension}, others have {lengths[dimension]}")
    if xarray is not None:
        return xarray.Dataset(columns, coordinates)
    return Table(columns, coordinates)
