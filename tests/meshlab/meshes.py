"""Tiny meshes, and the files in which hosts and the command get them."""
import numpy

# A vertex, 0, on one face of an octahedron, where it makes three flat triangles.
WART = numpy.array([[0.5, 0.3, 0.2], [1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]])
WART_FACES = numpy.array(
    [[1, 3, 0], [3, 5, 0], [5, 1, 0], [3, 2, 5], [2, 4, 5], [4, 1, 5], [3, 1, 6], [2, 3, 6], [4, 2, 6], [1, 4, 6]])


def grid(size=9, seed=1, jitter=0.3):
    """A flat square sheet of 2 * (size - 1)^2 triangles whose inner vertices lie where chance has put them."""
    chance = numpy.random.default_rng(seed)
    y, x = numpy.divmod(numpy.arange(size * size), size)
    vertices = numpy.stack([x, y, 0 * x], axis=1).astype(float)
    inner = (x % (size - 1) != 0) & (y % (size - 1) != 0)
    vertices[inner, :2] += chance.uniform(-jitter, jitter, (inner.sum(), 2))
    low = numpy.flatnonzero((x < size - 1) & (y < size - 1))
    faces = numpy.concatenate([numpy.stack([low, low + 1, low + size + 1], axis=1),
                               numpy.stack([low, low + size + 1, low + size], axis=1)])
    return vertices, faces


def squashed_grid():
    """A grid whose cells are five times as wide as high, so that its triangles are bad whatever moves."""
    vertices, faces = grid()
    return vertices * [1, 0.2, 1], faces


def rotated(triangles):
    """Each triangle from its least vertex on, all of them sorted: equal for meshes that differ in numbering only."""
    triangles = numpy.asarray(triangles)
    first = triangles.argmin(axis=1)[:, None]
    turned = numpy.take_along_axis(triangles, (first + [0, 1, 2]) % 3, axis=1)
    return [tuple(triangle) for triangle in turned[numpy.lexsort(turned.T[::-1])].tolist()]


def volume(vertices, faces):
    a, b, c = numpy.asarray(vertices, dtype=float)[numpy.asarray(faces)].transpose(1, 0, 2)
    return numpy.einsum('ij,ij->', a, numpy.cross(b, c)) / 6


_NAMES = {'f': 'float', 'd': 'double'}


def write_ply(path, vertices, faces, kind='d'):
    """A binary PLY file with coordinates in double ('d') or single ('f') precision."""
    header = (f'ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\n'
              + ''.join(f'property {_NAMES[kind]} {axis}\n' for axis in 'xyz')
              + f'element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n')
    rows = numpy.empty(len(faces), [('count', 'u1'), ('corners', '<i4', 3)])
    rows['count'], rows['corners'] = 3, faces
    path.write_bytes(header.encode() + numpy.asarray(vertices, kind).tobytes() + rows.tobytes())


def read_ply(path):
    """Vertices, in the file's precision, and faces of a binary PLY file of triangles, whatever else is there."""
    data = path.read_bytes()
    end = data.index(b'end_header\n') + len(b'end_header\n')
    kinds = {'float': '<f4', 'double': '<f8', 'uchar': 'u1', 'int': '<i4'}
    lines = [line.split() for line in data[:end].decode().splitlines()]
    counts = {line[1]: int(line[2]) for line in lines if line[0] == 'element'}
    split = lines.index(['element', 'face', str(counts['face'])])
    row = [(line[2], kinds[line[1]]) for line in lines[:split] if line[0] == 'property']
    vertices = numpy.frombuffer(data, row, counts['vertex'], end)
    face = [('count', 'u1'), ('corners', '<i4', 3)] + [
        (line[2], kinds[line[1]]) for line in lines[split:] if line[0] == 'property' and line[1] != 'list']
    faces = numpy.frombuffer(data, face, counts['face'], end + vertices.nbytes)
    return numpy.stack([vertices[axis] for axis in 'xyz'], axis=1), faces['corners']


def write_obj(path, vertices, faces, texture):
    """An OBJ file with texture coordinates, an u and a v for each corner of each face."""
    lines = ['v {!r} {!r} {!r}'.format(*map(float, vertex)) for vertex in vertices]
    lines += ['vt {!r} {!r}'.format(*map(float, pair)) for pair in texture]
    for number, corners in enumerate(numpy.asarray(faces)):
        lines.append('f ' + ' '.join(f'{v + 1}/{3 * number + k + 1}' for k, v in enumerate(corners)))
    path.write_text('\n'.join(lines) + '\n')
