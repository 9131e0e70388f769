// A CGAL Surface_mesh through qsmesh: positions and triangles out, the improved mesh and its properties back in.
// Texture coordinates at the vertices and materials at the faces come along through the maps. They are those of the
// same vertex and face as before; where a vertex has moved, its texture has moved with it.
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <qsmesh.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

using point = CGAL::Simple_cartesian<double>::Point_3;
using mesh = CGAL::Surface_mesh<point>;
using uv = std::array<float, 2>;

namespace {

constexpr double TURN = 6.283185307179586;
constexpr int AROUND = 60, ALONG = 40;

/* Where a vertex of the vase lies, from its texture coordinates. */
point on_vase(double u, double v)
{
    const double radius = 1 + 0.3 * std::sin(TURN * v);
    return {radius * std::cos(TURN * u), radius * std::sin(TURN * u), 4 * v};
}

/* An open vase whose vertices are scattered over it, with a seam of its texture left open. */
mesh make_vase()
{
    mesh m;
    auto texture = m.add_property_map<mesh::Vertex_index, uv>("v:uv").first;
    auto material = m.add_property_map<mesh::Face_index, int>("f:material").first;
    std::uint32_t state = 1;
    const auto shift = [&state] { return ((state = state * 1664525u + 1013904223u) >> 8) / 16777216.0 * 1.2 - 0.6; };
    for (int i = 0; i <= AROUND; i++) {
        for (int j = 0; j <= ALONG; j++) {
            const bool inside = i > 0 && i < AROUND && j > 0 && j < ALONG;
            const double u = (i + (inside ? shift() : 0)) / AROUND, v = (j + (inside ? shift() : 0)) / ALONG;
            texture[m.add_vertex(on_vase(u, v))] = {static_cast<float>(u), static_cast<float>(v)};
        }
    }
    const auto at = [](int i, int j) { return mesh::Vertex_index(static_cast<unsigned>(i * (ALONG + 1) + j)); };
    for (int i = 0; i < AROUND; i++) {
        for (int j = 0; j < ALONG; j++) {
            material[m.add_face(at(i, j), at(i + 1, j), at(i + 1, j + 1))] = j;
            material[m.add_face(at(i, j), at(i + 1, j + 1), at(i, j + 1))] = j;
        }
    }
    return m;
}

/* Positions and triangles of a mesh without removed elements, in their order. */
void copy_out(const mesh &m, std::vector<std::array<double, 3>> &points, std::vector<std::uint32_t> &corners)
{
    for (const auto v : m.vertices()) {
        points.push_back({m.point(v).x(), m.point(v).y(), m.point(v).z()});
    }
    for (const auto f : m.faces()) {
        for (const auto v : CGAL::vertices_around_face(m.halfedge(f), m)) {
            corners.push_back(static_cast<std::uint32_t>(v));
        }
    }
}

/* The mesh anew, each element with the properties of the one that it came from. */
mesh copy_in(const mesh &before, const std::vector<std::array<double, 3>> &points,
             const std::vector<std::uint32_t> &corners, const qsmesh::maps &from)
{
    mesh m;
    const auto old_texture = before.property_map<mesh::Vertex_index, uv>("v:uv").first;
    const auto old_material = before.property_map<mesh::Face_index, int>("f:material").first;
    auto texture = m.add_property_map<mesh::Vertex_index, uv>("v:uv").first;
    auto material = m.add_property_map<mesh::Face_index, int>("f:material").first;
    for (std::size_t v = 0; v < points.size(); v++) {
        const auto added = m.add_vertex({points[v][0], points[v][1], points[v][2]});
        texture[added] = old_texture[mesh::Vertex_index(from.vertex_source[v])];
    }
    for (std::size_t t = 0; t < from.triangle_source.size(); t++) {
        const auto corner = [&](std::size_t k) { return mesh::Vertex_index(corners[3 * t + k]); };
        material[m.add_face(corner(0), corner(1), corner(2))] = old_material[mesh::Face_index(from.triangle_source[t])];
    }
    return m;
}

/* Greatest distance between a vertex and the place that its texture coordinates stand for. Vertices on the border have
   not moved, so they are where their texture is; the others are as far off as they have moved. */
double texture_error(const mesh &m, bool on_border)
{
    const auto texture = m.property_map<mesh::Vertex_index, uv>("v:uv").first;
    double greatest = 0;
    for (const auto v : m.vertices()) {
        const point expected = on_vase(texture[v][0], texture[v][1]);
        if (m.is_border(v) == on_border) {
            greatest = std::max(greatest, std::sqrt(CGAL::squared_distance(m.point(v), expected)));
        }
    }
    return greatest;
}

/* Faces whose material is that of a ring of the vase which they touch no more. */
std::size_t strayed_materials(const mesh &m)
{
    const auto material = m.property_map<mesh::Face_index, int>("f:material").first;
    return static_cast<std::size_t>(std::count_if(m.faces_begin(), m.faces_end(), [&](mesh::Face_index f) {
        double height = 0;
        for (const auto v : CGAL::vertices_around_face(m.halfedge(f), m)) {
            height += m.point(v).z() / 3;
        }
        return std::fabs(height / 4 * ALONG - material[f] - 0.5) > 2;
    }));
}

} // namespace

int main()
{
    const mesh before = make_vase();
    std::vector<std::array<double, 3>> points;
    std::vector<std::uint32_t> corners;
    copy_out(before, points, corners);

    qsmesh::options options;
    options.feature_angle = 0;
    qsmesh::maps from;
    qsmesh::report report;
    qsmesh::improve(points, corners, options, from, &report);
    const mesh after = copy_in(before, points, corners, from);

    std::printf("before: %u vertices, %u faces, angle min %.2f, edge_ratio mean %.4f\n", before.number_of_vertices(),
                before.number_of_faces(), report.before.min_angle.min, report.before.edge_ratio.mean);
    std::printf("after: %u vertices, %u faces, angle min %.2f, edge_ratio mean %.4f\n", after.number_of_vertices(),
                after.number_of_faces(), report.after.min_angle.min, report.after.edge_ratio.mean);
    std::printf("properties: valid %d, texture off by %.6f on the border and %.4f inside, "
                "faces with strayed material %zu\n",
                after.is_valid(false) ? 1 : 0, texture_error(after, true), texture_error(after, false),
                strayed_materials(after));
    return 0;
}
