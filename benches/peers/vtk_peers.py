"""VTK's smoothing filters: the plain one, the same with projection back onto the surface, and the one on a leash."""

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints, vtkSMPTools
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkConstrainedSmoothingFilter, vtkSmoothPolyDataFilter

vtkSMPTools.Initialize(1)

# The filters' default, 0.01, moves next to nothing in two iterations; this is what other Laplacians take.
RELAXATION = 0.5
# The leash of the constrained filter, in diagonals of the bounding box.
LEASH = 0.001


class VtkPeer:
    def __init__(self, positions, triangles):
        points = vtkPoints()
        points.SetData(numpy_to_vtk(numpy.ascontiguousarray(positions), deep=True))
        cells = vtkCellArray()
        offsets = numpy.arange(0, 3 * len(triangles) + 1, 3, dtype=numpy.int64)
        corners = triangles.astype(numpy.int64).ravel()
        cells.SetData(numpy_to_vtkIdTypeArray(offsets, deep=True), numpy_to_vtkIdTypeArray(corners, deep=True))
        self.surface = vtkPolyData()
        self.surface.SetPoints(points)
        self.surface.SetPolys(cells)
        self.filter = self.make_filter()
        self.filter.SetRelaxationFactor(RELAXATION)
        self.filter.SetInputData(self.surface)

    def smooth(self, iterations):
        self.filter.SetNumberOfIterations(iterations)
        self.filter.Update()

    def positions(self):
        return vtk_to_numpy(self.filter.GetOutput().GetPoints().GetData()).astype(float)


class VtkLaplacian(VtkPeer):
    name = "VTK Laplacian"

    def make_filter(self):
        made = vtkSmoothPolyDataFilter()
        made.BoundarySmoothingOff()
        return made


class VtkReprojected(VtkLaplacian):
    name = "VTK Laplacian, projected"

    def make_filter(self):
        made = super().make_filter()
        made.SetSourceData(self.surface)
        return made


class VtkConstrained(VtkPeer):
    name = "VTK constrained"

    def make_filter(self):
        made = vtkConstrainedSmoothingFilter()
        made.SetConstraintStrategyToConstraintDistance()
        made.SetConstraintDistance(LEASH * self.surface.GetLength())
        return made


PEERS = [VtkLaplacian, VtkReprojected, VtkConstrained]
