"""Makes Grainstep's styles known to an unmodified LAMMPS (its Python package, as Debian's lmp has it). In a script:

    python grainstep_register input 1 SELF format p file grainstep_lammps.py
    python grainstep_register invoke
    fix coupling all grainstep/coupling ${endpoint}

The library is looked for in GRAINSTEP_LAMMPS_LIBRARY, else where the system's loader looks.
"""
import ctypes
import os


def grainstep_register(pointer):
    """`pointer`: LAMMPS's own, as the command `python` hands it over with format p."""
    handle = ctypes.pythonapi.PyCapsule_GetPointer
    handle.restype, handle.argtypes = ctypes.c_void_p, [ctypes.py_object, ctypes.c_char_p]
    library = ctypes.CDLL(os.environ.get("GRAINSTEP_LAMMPS_LIBRARY", "libgrainstep_lammps.so"))
    library.grainstep_register.argtypes = [ctypes.c_void_p]
    library.grainstep_register(handle(pointer, None))
