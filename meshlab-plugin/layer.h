// SPDX-License-Identifier: GPL-3.0-or-later
/// The current layer as the library wants it, and the way back.
#ifndef QSMESH_LAYER_H
#define QSMESH_LAYER_H

#include <cstdint>
#include <vector>

#include "host.h"

namespace qsmesh {

/// The elements of a layer that are not deleted, numbered from 0 in their order. Packing leaves the layer as it is: its
/// deleted elements stay where they are.
struct Packed {
    /// x, y, z of each vertex.
    std::vector<Scalarm> positions;
    /// Three vertex numbers a triangle.
    std::vector<uint32_t> indices;
    std::vector<CVertexO*> vertices;
    std::vector<CFaceO*> faces;
    /// For each vertex of the layer its number here; meaningless for a deleted one.
    std::vector<uint32_t> numbers;
};

/// Where everything came from, as in qsm_maps.
struct Sources {
    std::vector<uint32_t> vertices, triangles, corners;
};

/// Throws MLException for a layer without triangles, or that contradicts itself.
Packed pack(CMeshO& mesh);

/// Throws MLException if a face of the layer is part of a larger polygon.
void requirePureTriangles(const Packed& packed);

/// Gives the layer the triangles in indices. A vertex that is still there stays the element that it was, with all that
/// it carries; so does the first face of each source, and further ones carry the same. Corners take what they carry
/// from their sources. Other elements are marked as deleted, and packed names those that are left.
void reconnect(MeshModel& model, Packed& packed, const Sources& sources);

/// Gives the layer's vertices the packed positions; brings bounding box and normals up to date.
void reposition(MeshModel& model, const Packed& packed);

/// Throws deleted elements out of the layer, so that pointers to its elements mean nothing any more.
void compact(MeshModel& model);

}  // namespace qsmesh

#endif
