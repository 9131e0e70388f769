"""MeshLab's Laplacian, by way of PyMeshLab."""

import numpy
import pymeshlab


class MeshLabLaplacian:
    name = "MeshLab Laplacian"

    def __init__(self, positions, triangles):
        self.meshes = pymeshlab.MeshSet()
        self.meshes.add_mesh(pymeshlab.Mesh(positions, triangles))

    def smooth(self, iterations):
        # Every neighbour weighs the same. The boundary cannot be held: it is smoothed along itself.
        self.meshes.apply_coord_laplacian_smoothing(stepsmoothnum=iterations, boundary=True, cotangentweight=False)

    def positions(self):
        return numpy.asarray(self.meshes.current_mesh().vertex_matrix())


PEERS = [MeshLabLaplacian]
