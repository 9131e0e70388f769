"""PyMeshLab with the plugin loaded: layers in, arrays and figures out."""
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy
import pymeshlab

SMOOTH = 'apply_coord_quasi_statistical_smoothing'
IMPROVE = 'meshing_quasi_statistical_improvement'

pymeshlab.load_plugin(os.environ['QSMESH_PLUGIN'])

# PyMeshLab's readers write into the log of a document that was there before, even if that has gone; so none may go.
_documents = []


def new_document():
    _documents.append(pymeshlab.MeshSet())
    return _documents[-1]


class Case(unittest.TestCase):
    """A test with a folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def assertBits(self, left, right):
        """Equal to the bit, NaN included."""
        left, right = numpy.ascontiguousarray(left), numpy.ascontiguousarray(right)
        self.assertEqual((left.dtype, left.shape), (right.dtype, right.shape))
        self.assertEqual(left.tobytes(), right.tobytes())

    def assertRefused(self, message, layer, filter_name, **options):
        """An error that a script can catch, with `message` in it, that leaves the layer as it was."""
        before = layer.current_mesh().vertex_matrix(), layer.current_mesh().face_matrix()
        with self.assertRaises(pymeshlab.PyMeshLabException) as caught:
            layer.apply_filter(filter_name, **options)
        self.assertIn(message, str(caught.exception))
        self.assertBits(layer.current_mesh().vertex_matrix(), before[0])
        self.assertBits(layer.current_mesh().face_matrix(), before[1])


def layer_of(vertices, faces=None, **arrays):
    """A document with one layer."""
    document = new_document()
    if faces is None:
        document.add_mesh(pymeshlab.Mesh(vertices, **arrays))
    else:
        document.add_mesh(pymeshlab.Mesh(vertices, faces, **arrays))
    return document


def layer_from(path):
    document = new_document()
    document.load_new_mesh(str(path))
    return document


def select(document, vertices='vi < 0', faces='fi < 0'):
    """Selects the vertices and the faces for which expressions in vi and fi hold."""
    document.apply_filter('compute_selection_by_condition_per_vertex', condselect=f'({vertices})')
    document.apply_filter('compute_selection_by_condition_per_face', condselect=f'({faces})')


def layer_value(distance):
    """An absolute-or-percent option, as a distance."""
    return getattr(pymeshlab, 'PureValue', getattr(pymeshlab, 'AbsoluteValue', None))(distance)


def command(*arguments):
    """Runs the qsmesh command; returns what it prints."""
    call = [os.environ['QSMESH_COMMAND'], *map(str, arguments)]
    return subprocess.run(call, check=True, stdout=subprocess.PIPE, text=True).stdout
