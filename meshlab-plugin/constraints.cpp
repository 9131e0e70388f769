// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints.h"

#include <algorithm>
#include <set>
#include <tuple>

namespace qsmesh {

namespace {

// ---- selection ----

/// Locks every vertex that is not selected.
std::vector<uint8_t> lockOutsideVertices(const Packed& packed) {
    std::vector<uint8_t> lock;
    for (const CVertexO* vertex : packed.vertices) lock.push_back(!vertex->IsS());
    return lock;
}

/// Locks every vertex that has a face that is not selected, or no face.
std::vector<uint8_t> lockOutsideFaces(const Packed& packed) {
    std::vector<uint8_t> lock(packed.vertices.size(), 1);
    for (const bool selected : {true, false})
        for (size_t face = 0; face < packed.faces.size(); ++face)
            for (int corner = 0; corner < 3 && packed.faces[face]->IsS() == selected; ++corner)
                lock[packed.indices[3 * face + corner]] = !selected;
    return lock;
}

bool allLocked(const std::vector<uint8_t>& lock) {
    return std::all_of(lock.begin(), lock.end(), [](uint8_t locked) { return locked != 0; });
}

void keepUnselectedVertices(const Packed& packed, Constraints& constraints) {
    constraints.vertexLock = lockOutsideVertices(packed);
    const auto isFree = [&](uint32_t vertex) { return !constraints.vertexLock[vertex]; };
    for (size_t face = 0; face < packed.faces.size(); ++face) {
        const uint32_t* corners = &packed.indices[3 * face];
        constraints.triangleMask.push_back(std::any_of(corners, corners + 3, isFree));
    }
}

void keepUnselectedFaces(const Packed& packed, Constraints& constraints) {
    constraints.vertexLock = lockOutsideFaces(packed);
    if (allLocked(constraints.vertexLock))
        throw MLException("no vertex has all its faces selected: select more faces, or vertices");
    for (const CFaceO* face : packed.faces) constraints.triangleMask.push_back(face->IsS());
}

/// Locks vertices, and with them the faces outside: the library changes no triangle that has all its vertices locked.
void keepUnselected(const CMeshO& mesh, const Packed& packed, Constraints& constraints) {
    if (!anythingSelected(mesh))
        throw MLException("nothing is selected: select vertices or faces, or switch off Affect only selection");
    if (allLocked(lockOutsideVertices(packed)))
        keepUnselectedFaces(packed, constraints);
    else
        keepUnselectedVertices(packed, constraints);
}

/// Locks vertices of the layer's polylines: these would name a vertex that is gone.
void keepPolylines(const CMeshO& mesh, const Packed& packed, Constraints& constraints) {
    if (mesh.en == 0) return;
    constraints.vertexLock.resize(packed.vertices.size(), 0);
    for (const auto& edge : mesh.edge)
        for (int end = 0; end < 2 && !edge.IsD(); ++end)
            constraints.vertexLock[packed.numbers[vcg::tri::Index(mesh, edge.cV(end))]] = 1;
}

// ---- edges ----

/// An edge as a triangle sees it.
struct Side {
    /// Vertex numbers, low < high.
    uint32_t low, high;
    uint32_t face;
    /// Corners of the face that these vertices are.
    uint8_t lowCorner, highCorner;

    bool isSameEdge(const Side& other) const { return low == other.low && high == other.high; }
};

/// All sides of all edges, those of one edge beside each other.
std::vector<Side> sidesByEdge(const Packed& packed) {
    std::vector<Side> sides;
    for (uint32_t face = 0; face < packed.faces.size(); ++face)
        for (uint8_t k = 0; k < 3; ++k) {
            const uint8_t l = (k + 1) % 3;
            const uint32_t first = packed.indices[3 * face + k], second = packed.indices[3 * face + l];
            sides.push_back(first < second ? Side{first, second, face, k, l} : Side{second, first, face, l, k});
        }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        return std::tie(a.low, a.high, a.face, a.lowCorner) < std::tie(b.low, b.high, b.face, b.lowCorner);
    });
    return sides;
}

/// Which edges are kept.
struct Borders {
    const Packed& packed;
    bool seams, colours;

    bool parts(const Side& a, const Side& b) const {
        CFaceO &one = *packed.faces[a.face], &other = *packed.faces[b.face];
        if (colours && one.C() != other.C()) return true;
        return seams && (one.WT(a.lowCorner) != other.WT(b.lowCorner) ||
                         one.WT(a.highCorner) != other.WT(b.highCorner));
    }
};

/// Edges along which faces part.
std::vector<uint32_t> keptEdges(const Borders& borders) {
    std::vector<uint32_t> edges;
    if (!borders.seams && !borders.colours) return edges;
    const std::vector<Side> sides = sidesByEdge(borders.packed);
    for (auto first = sides.begin(), end = first; first != sides.end(); first = end) {
        end = std::find_if(first, sides.end(), [&](const Side& side) { return !side.isSameEdge(*first); });
        const bool kept = std::any_of(first, end, [&](const Side& side) { return borders.parts(*first, side); });
        if (kept) edges.insert(edges.end(), {first->low, first->high});
    }
    return edges;
}

}  // namespace

bool coloursAreRegions(const CMeshO& mesh) {
    if (!vcg::tri::HasPerFaceColor(mesh)) return false;
    std::set<uint32_t> colours;
    for (const auto& face : mesh.face) {
        if (face.IsD()) continue;
        const auto& colour = face.cC();
        colours.insert(uint32_t(colour[0]) << 24 | uint32_t(colour[1]) << 16 | uint32_t(colour[2]) << 8 | colour[3]);
        if (colours.size() > MOST_REGION_COLOURS) return false;
    }
    return colours.size() > 1;
}

bool anythingSelected(const CMeshO& mesh) {
    const auto isSelected = [](const auto& element) { return !element.IsD() && element.IsS(); };
    return std::any_of(mesh.vert.begin(), mesh.vert.end(), isSelected) ||
           std::any_of(mesh.face.begin(), mesh.face.end(), isSelected);
}

void Constraints::lendTo(qsm_options& options) const {
    options.vertex_lock = vertexLock.empty() ? nullptr : vertexLock.data();
    options.triangle_mask = triangleMask.empty() ? nullptr : triangleMask.data();
    options.feature_edges = edges.empty() ? nullptr : edges.data();
    options.feature_edge_count = edges.size() / 2;
}

Constraints readConstraints(Filter filter, const RichParameterList& list, const CMeshO& mesh, const Packed& packed) {
    Constraints constraints;
    if (list.getBool("selected")) keepUnselected(mesh, packed, constraints);
    if (filter == IMPROVE) keepPolylines(mesh, packed, constraints);
    const bool seams = vcg::tri::HasPerWedgeTexCoord(mesh) && list.getBool("keep_seams");
    const bool colours = vcg::tri::HasPerFaceColor(mesh) && list.getBool("keep_color_borders");
    constraints.edges = keptEdges({packed, seams, colours});
    return constraints;
}

}  // namespace qsmesh
