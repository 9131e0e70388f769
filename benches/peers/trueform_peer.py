"""trueform's Laplacian. It also has Taubin's smoothing and a remeshing; neither moves vertices
along the surface only."""

import numpy
import trueform


class TrueformLaplacian:
    name = "trueform Laplacian"

    def __init__(self, positions, triangles):
        points = numpy.ascontiguousarray(positions, dtype=numpy.float64)
        self.mesh = trueform.Mesh(triangles.astype(numpy.int32), points)

    def smooth(self, iterations):
        self.smoothed = trueform.laplacian_smoothed(self.mesh, iterations=iterations, lambda_=0.5)

    def positions(self):
        return numpy.asarray(self.smoothed, dtype=float)


PEERS = [TrueformLaplacian]
