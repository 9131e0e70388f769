// SPDX-License-Identifier: GPL-3.0-or-later
#include "layer.h"

#include <utility>

namespace qsmesh {

namespace {

constexpr uint32_t DELETED = UINT32_MAX;

void packVertices(CMeshO& mesh, Packed& packed) {
    packed.numbers.assign(mesh.vert.size(), DELETED);
    for (auto& vertex : mesh.vert) {
        if (vertex.IsD()) continue;
        packed.numbers[vcg::tri::Index(mesh, vertex)] = uint32_t(packed.vertices.size());
        packed.vertices.push_back(&vertex);
        for (int axis = 0; axis < 3; ++axis) packed.positions.push_back(vertex.cP()[axis]);
    }
}

void packFaces(CMeshO& mesh, Packed& packed) {
    for (auto& face : mesh.face) {
        if (face.IsD()) continue;
        packed.faces.push_back(&face);
        for (int corner = 0; corner < 3; ++corner) {
            const uint32_t number = packed.numbers[vcg::tri::Index(mesh, face.cV(corner))];
            if (number == DELETED) throw MLException("a face of the layer names a deleted vertex");
            packed.indices.push_back(number);
        }
    }
}

/// What a corner of a face carries, and the edge that begins there.
struct Corner {
    CFaceO::TexCoordType texture;
    bool edgeSelected;
};

/// What each new corner is to carry. An edge is the old one if both its corners come from one triangle in their order.
std::vector<Corner> gatherCorners(const CMeshO& mesh, const Packed& packed, const std::vector<uint32_t>& sources) {
    const bool textured = vcg::tri::HasPerWedgeTexCoord(mesh);
    std::vector<Corner> corners(sources.size());
    for (size_t corner = 0; corner < sources.size(); ++corner) {
        const size_t next = corner - corner % 3 + (corner + 1) % 3;
        const uint32_t source = sources[corner];
        const uint32_t sourceNext = source - source % 3 + (source + 1) % 3;
        CFaceO& face = *packed.faces[source / 3];
        if (textured) corners[corner].texture = face.WT(source % 3);
        corners[corner].edgeSelected = sources[next] == sourceNext && face.IsFaceEdgeS(source % 3);
    }
    return corners;
}

/// The elements that stay, or that go: those that a source names, or that none names.
template <class Element>
std::vector<Element*> pick(const std::vector<Element*>& elements, const std::vector<uint32_t>& sources, bool staying) {
    std::vector<bool> stays(elements.size(), false);
    for (const uint32_t source : sources) stays[source] = true;
    std::vector<Element*> picked;
    for (size_t element = 0; element < elements.size(); ++element)
        if (stays[element] == staying) picked.push_back(elements[element]);
    return picked;
}

/// Makes a face carry all that another one carries.
void copyFace(CMeshO& mesh, CFaceO& to, CFaceO& from) {
    to.ImportData(from);
    for (const auto& attribute : mesh.face_attr)
        attribute._handle->CopyValue(vcg::tri::Index(mesh, to), vcg::tri::Index(mesh, from), attribute._handle);
}

/// The face for each triangle: its source or, where an earlier triangle has that, one of the unused faces, which are
/// taken from the end. There are enough of them, as a mesh never comes out with more triangles than went in.
std::vector<CFaceO*> placeFaces(const std::vector<CFaceO*>& faces, const std::vector<uint32_t>& sources,
                                std::vector<CFaceO*>& unused) {
    std::vector<bool> taken(faces.size(), false);
    std::vector<CFaceO*> places;
    for (const uint32_t source : sources) {
        if (taken[source] && unused.empty()) throw MLException("more triangles came out than went in");
        places.push_back(taken[source] ? unused.back() : faces[source]);
        if (taken[source]) unused.pop_back();
        taken[source] = true;
    }
    return places;
}

void writeFaces(CMeshO& mesh, const Packed& packed, const std::vector<Corner>& corners) {
    const bool textured = vcg::tri::HasPerWedgeTexCoord(mesh);
    for (size_t corner = 0; corner < corners.size(); ++corner) {
        CFaceO& face = *packed.faces[corner / 3];
        const int k = int(corner % 3);
        face.V(k) = packed.vertices[packed.indices[corner]];
        if (textured) face.WT(k) = corners[corner].texture;
        corners[corner].edgeSelected ? face.SetFaceEdgeS(k) : face.ClearFaceEdgeS(k);
    }
}

}  // namespace

Packed pack(CMeshO& mesh) {
    Packed packed;
    packVertices(mesh, packed);
    packFaces(mesh, packed);
    if (packed.vertices.empty()) throw MLException("the layer is empty: there are no triangles to improve");
    if (packed.faces.empty()) throw MLException("the layer is a point cloud: there are no triangles to improve");
    return packed;
}

void requirePureTriangles(const Packed& packed) {
    for (const CFaceO* face : packed.faces)
        if (face->IsAnyF())
            throw MLException("the layer has faces with more than three corners, whose triangles cannot be changed one "
                              "by one: apply \"Turn into a Pure-Triangular mesh\" first, or smooth it");
}

void reconnect(MeshModel& model, Packed& packed, const Sources& sources) {
    // What needs memory comes before what changes the layer.
    CMeshO& mesh = model.cm;
    const std::vector<Corner> corners = gatherCorners(mesh, packed, sources.corners);
    const std::vector<CVertexO*> goneVertices = pick(packed.vertices, sources.vertices, false);
    packed.vertices = pick(packed.vertices, sources.vertices, true);
    std::vector<CFaceO*> goneFaces = pick(packed.faces, sources.triangles, false);
    const std::vector<CFaceO*> former = std::move(packed.faces);
    packed.faces = placeFaces(former, sources.triangles, goneFaces);
    // They hold pointers to neighbours of before.
    model.clearDataMask(MeshModel::MM_FACEFACETOPO | MeshModel::MM_VERTFACETOPO);
    for (size_t triangle = 0; triangle < packed.faces.size(); ++triangle) {
        CFaceO* source = former[sources.triangles[triangle]];
        if (packed.faces[triangle] != source) copyFace(mesh, *packed.faces[triangle], *source);
    }
    writeFaces(mesh, packed, corners);
    for (CFaceO* face : goneFaces) vcg::tri::Allocator<CMeshO>::DeleteFace(mesh, *face);
    for (CVertexO* vertex : goneVertices) vcg::tri::Allocator<CMeshO>::DeleteVertex(mesh, *vertex);
}

void reposition(MeshModel& model, const Packed& packed) {
    for (size_t vertex = 0; vertex < packed.vertices.size(); ++vertex) {
        const Scalarm* position = &packed.positions[3 * vertex];
        packed.vertices[vertex]->P() = Point3m(position[0], position[1], position[2]);
    }
#if QSMESH_MESHLAB_INTERFACE == 2020
    model.UpdateBoxAndNormals();
#else
    model.updateBoxAndNormals();
#endif
}

void compact(MeshModel& model) {
    vcg::tri::Allocator<CMeshO>::CompactFaceVector(model.cm);
    vcg::tri::Allocator<CMeshO>::CompactVertexVector(model.cm);
    vcg::tri::UpdateFlags<CMeshO>::FaceBorderFromNone(model.cm);
    vcg::tri::UpdateFlags<CMeshO>::VertexBorderFromFaceBorder(model.cm);
}

}  // namespace qsmesh
