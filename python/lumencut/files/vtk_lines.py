"""Centerlines of VTK in memory, as the bytes of the file that VTK would write."""

from __future__ import annotations

import importlib
from typing import Any


def is_poly_data(source: Any) -> bool:
    """Return whether an object is a vtkPolyData, which requires that VTK is loaded."""
    of_vtk = any(cls.__module__.partition(".")[0] == "vtkmodules" for cls in type(source).__mro__)
    return of_vtk and hasattr(source, "GetLines") and hasattr(source, "GetPolys")


def file_of(poly_data: Any) -> bytes:
    """Return the content of the `.vtp` file that VTK writes of poly data, with exact numbers."""
    writer = importlib.import_module("vtkmodules.vtkIOXML").vtkXMLPolyDataWriter()
    writer.SetInputData(poly_data)
    writer.SetDataModeToBinary()
    writer.SetCompressorTypeToNone()
    writer.WriteToOutputStringOn()
    writer.Write()
    content: str = writer.GetOutputString()
    return content.encode()
