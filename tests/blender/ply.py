"""Reads and writes binary little-endian PLY files of triangles, as the horse and the command's demo are."""

import numpy

KINDS = {
    "float": "<f4", "float32": "<f4", "double": "<f8", "float64": "<f8", "uchar": "u1", "uint8": "u1", "char": "i1",
    "short": "<i2", "ushort": "<u2", "int": "<i4", "int32": "<i4", "uint": "<u4", "uint32": "<u4",
}


def read(path):
    """positions, float32 (vertices, 3), and triangles, (triangles, 3)."""
    with open(path, "rb") as file:
        content = file.read()
    end = content.index(b"end_header\n") + len(b"end_header\n")
    header = content[:end].decode().splitlines()
    assert "format binary_little_endian 1.0" in header, header
    vertex_kind, vertices, face_kind, triangles = _layout(header)
    table = numpy.frombuffer(content, vertex_kind, vertices, end)
    positions = numpy.stack([table[axis] for axis in "xyz"], axis=1).astype(numpy.float32)
    rows = numpy.frombuffer(content, face_kind, triangles, end + table.nbytes)
    assert (rows["count"] == 3).all()
    return positions, rows["corners"].astype(numpy.int64)


def _layout(header):
    vertex_fields, counts, list_kinds, element = [], {}, None, None
    for words in map(str.split, header):
        if words[0] == "element":
            element = words[1]
            counts[element] = int(words[2])
        elif words[0] == "property" and words[1] == "list":
            list_kinds = KINDS[words[2]], KINDS[words[3]]
        elif words[0] == "property" and element == "vertex":
            vertex_fields.append((words[2], KINDS[words[1]]))
    face = numpy.dtype([("count", list_kinds[0]), ("corners", list_kinds[1], 3)])
    return numpy.dtype(vertex_fields), counts["vertex"], face, counts["face"]


def write(path, positions, triangles):
    """Writes float coordinates and triangles."""
    header = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(positions)}\nproperty float x\nproperty float y\n"
        f"property float z\nelement face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    rows = numpy.empty(len(triangles), dtype=[("count", "u1"), ("corners", "<i4", 3)])
    rows["count"], rows["corners"] = 3, triangles
    with open(path, "wb") as file:
        file.write(header.encode() + numpy.asarray(positions, dtype="<f4").tobytes() + rows.tobytes())
