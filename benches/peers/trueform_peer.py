"""trueform's Laplacian. It also has Taubin's smoothing and a remeshing; neither keeps at improving triangles in place."""

import numpy
import trueform


class TrueformLaplacian:
    name = "trueform Laplacian"

    def __init__(self, positions, triangles):
        self.mesh = trueform.Mesh(triangles.astype(numpy.int32), numpy.ascontiguousarray(positions, dtype=numpy.float64))

    def smooth(self, iterations):
        self.smoothed = trueform.laplacian_smoothed(self.mesh, iterations=iterations, lambda_=0.5)

    def positions(self):
        return numpy.asarray(self.smoothed, dtype=float)


PEERS = [TrueformLaplacian]
