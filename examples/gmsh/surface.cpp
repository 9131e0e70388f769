#include "surface.hpp"

#include <gmsh.h>

#include <cstdlib>
#include <unordered_map>
#include <utility>

namespace {

constexpr int LINE = 1, TRIANGLE = 2;

using numbering = std::unordered_map<std::size_t, std::uint32_t>;

numbering add_nodes(surface &s)
{
    std::vector<double> coordinates, parameters;
    gmsh::model::mesh::getNodes(s.tags, coordinates, parameters, -1, -1, false, false);
    numbering numbers;
    for (std::size_t v = 0; v < s.tags.size(); v++) {
        s.points.push_back({coordinates[3 * v], coordinates[3 * v + 1], coordinates[3 * v + 2]});
        numbers.emplace(s.tags[v], static_cast<std::uint32_t>(v));
    }
    return numbers;
}

/* Triangles wound so that the part lies behind all of them; a face of the part may be an inner side for CAD. */
void add_faces(surface &s, const numbering &numbers, int part)
{
    gmsh::vectorpair faces;
    gmsh::model::getBoundary({{3, part}}, faces);
    for (const auto &[dimension, signed_tag] : faces) {
        const int face = std::abs(signed_tag);
        s.turned[face] = signed_tag < 0;
        std::vector<std::size_t> elements, nodes;
        gmsh::model::mesh::getElementsByType(TRIANGLE, elements, nodes, face);
        for (std::size_t i = 0; i < nodes.size(); i += 3) {
            triangle corners{numbers.at(nodes[i]), numbers.at(nodes[i + 1]), numbers.at(nodes[i + 2])};
            if (s.turned[face]) {
                std::swap(corners[1], corners[2]);
            }
            s.triangles.push_back(corners);
            s.faces.push_back(face);
        }
    }
}

void add_edges(surface &s, const numbering &numbers)
{
    s.on_edges.assign(s.points.size(), 0);
    std::vector<std::size_t> elements, nodes;
    gmsh::model::mesh::getElementsByType(LINE, elements, nodes);
    for (std::size_t i = 0; i < nodes.size(); i += 2) {
        s.edges.push_back({numbers.at(nodes[i]), numbers.at(nodes[i + 1])});
        s.on_edges[s.edges.back()[0]] = s.on_edges[s.edges.back()[1]] = 1;
    }
}

/* Replaces the mesh of one face: nodes inside it, projected onto it, and its triangles. */
void write_face(const surface &s, int face, const std::vector<std::uint32_t> &inside)
{
    std::vector<std::size_t> tags, corners;
    std::vector<double> moved, on_face, parameters;
    for (const std::uint32_t v : inside) {
        tags.push_back(s.tags[v]);
        moved.insert(moved.end(), s.points[v].begin(), s.points[v].end());
    }
    if (!tags.empty()) {
        gmsh::model::getClosestPoint(2, face, moved, on_face, parameters);
        gmsh::model::mesh::addNodes(2, face, tags, on_face, parameters);
    }
    for (std::size_t t = 0; t < s.triangles.size(); t++) {
        if (s.faces[t] == face) {
            const triangle &c = s.triangles[t];
            const bool turned = s.turned.at(face);
            corners.insert(corners.end(), {s.tags[c[0]], s.tags[c[turned ? 2 : 1]], s.tags[c[turned ? 1 : 2]]});
        }
    }
    gmsh::model::mesh::addElementsByType(face, TRIANGLE, {}, corners);
}

} // namespace

void write_surface(const surface &s)
{
    std::map<int, std::vector<std::uint32_t>> inside;
    std::vector<std::uint8_t> seen(s.points.size(), 0);
    for (std::size_t t = 0; t < s.triangles.size(); t++) {
        auto &of_face = inside[s.faces[t]];
        for (const std::uint32_t v : s.triangles[t]) {
            if (!seen[v] && !s.on_edges[v]) {
                of_face.push_back(v);
            }
            seen[v] = 1;
        }
    }
    for (const auto &[face, vertices] : inside) {
        gmsh::model::mesh::clear({{2, face}});
    }
    for (const auto &[face, vertices] : inside) {
        write_face(s, face, vertices);
    }
}

surface read_surface(int part)
{
    surface s;
    const numbering numbers = add_nodes(s);
    add_faces(s, numbers, part);
    add_edges(s, numbers);
    return s;
}
