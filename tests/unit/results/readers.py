"""Independent readers of what the writers wrote: h5py, and VTK's XML readers. Prints one fact per line."""
import sys


def hdf5(path):
    import h5py

    def show(name, item):
        if isinstance(item, h5py.Dataset):
            text = lambda key: item.attrs[key].decode() if isinstance(item.attrs[key], bytes) else item.attrs[key]
            value = item[()].tolist() if item.dtype.kind in "fiu" else item[()].decode()
            print(f"{name} unit={text('unit')!s} title={text('title')!s} {value}")

    with h5py.File(path, "r") as file:
        file.visititems(show)


def vtk(path):
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader

    reader = vtkXMLPolyDataReader() if path.endswith(".vtp") else vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    data = reader.GetOutput()
    print("points", data.GetNumberOfPoints(), "cells", data.GetNumberOfCells())
    print("types", sorted({data.GetCellType(i) for i in range(data.GetNumberOfCells())}))
    print("coordinates", vtk_to_numpy(data.GetPoints().GetData()).tolist())
    for kind, arrays in (("point", data.GetPointData()), ("cell", data.GetCellData())):
        for i in range(arrays.GetNumberOfArrays()):
            print(kind, arrays.GetArrayName(i), vtk_to_numpy(arrays.GetArray(i)).tolist())


def collection(path):
    import xml.etree.ElementTree as tree

    for entry in tree.parse(path).getroot().iter("DataSet"):
        print(entry.get("timestep"), entry.get("file"))


{"hdf5": hdf5, "vtk": vtk, "collection": collection}[sys.argv[1]](sys.argv[2])
