// Meshes a CAD part with gmsh: its surface, then its volume; once as it is, and once with qsmesh between the two.
// Prints what surface and tetrahedra are like. CAD edges are handed over as features and their nodes stay where they
// are, as the lines between them belong to the CAD model; all other nodes are put back onto the CAD surface.
#include <gmsh.h>
#include <qsmesh.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <unordered_map>

namespace {

using point = std::array<double, 3>;
using triangle = std::array<std::uint32_t, 3>;

constexpr int LINE = 1, TRIANGLE = 2, TETRAHEDRON = 4;

/* The mesh of all faces of the part, numbered from 0. */
struct surface {
    std::vector<std::size_t> tags;
    std::vector<point> points;
    std::vector<triangle> triangles;
    /* CAD face of each triangle, and whether the part lies on the other side of it than its normal says. */
    std::vector<int> faces;
    std::map<int, bool> turned;
    std::vector<std::uint8_t> on_edges;
    std::vector<std::array<std::uint32_t, 2>> edges;
};

/* A plate with a boss and a rounded hollow, drilled through. */
int make_part()
{
    namespace occ = gmsh::model::occ;
    occ::addBox(0, 0, 0, 6, 4, 1, 1);
    occ::addCylinder(1.6, 2, 0.5, 0, 0, 2, 1.1, 2);
    occ::addCylinder(1.6, 2, -1, 0, 0, 4, 0.6, 3);
    occ::addSphere(4.4, 2, 1.5, 1.2, 4);
    gmsh::vectorpair joined, part;
    std::vector<gmsh::vectorpair> map;
    occ::fuse({{3, 1}}, {{3, 2}}, joined, map);
    occ::cut(joined, {{3, 3}, {3, 4}}, part, map);
    occ::synchronize();
    return part.at(0).second;
}

/* By Delaunay, gmsh's choice for meshes whose sizes vary. Its own smoothing is left to qsmesh. */
void mesh_surface()
{
    gmsh::option::setNumber("Mesh.MeshSizeMin", 0.03);
    gmsh::option::setNumber("Mesh.MeshSizeMax", 0.3);
    gmsh::option::setNumber("Mesh.MeshSizeFromCurvature", 40);
    gmsh::option::setNumber("Mesh.Algorithm", 5);
    gmsh::option::setNumber("Mesh.Smoothing", 0);
    gmsh::model::mesh::generate(2);
}

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

/* CAD knows its edges, so none are to be found by angle. What was asked of tags and faces is brought along. */
qsmesh::report improve(surface &s)
{
    qsmesh::options options;
    options.feature_angle = 0;
    options.tail_min_angle = 30;
    options.tail_max_angle = 110;
    options.lock(s.on_edges).features(s.edges);
    qsmesh::maps maps;
    qsmesh::report report;
    qsmesh::improve(s.points, s.triangles, options, maps, &report);
    for (std::size_t v = 0; v < maps.vertex_source.size(); v++) {
        s.tags[v] = s.tags[maps.vertex_source[v]];
    }
    s.tags.resize(s.points.size());
    std::vector<int> faces;
    for (const std::uint32_t from : maps.triangle_source) {
        faces.push_back(s.faces[from]);
    }
    s.faces = faces;
    return report;
}

/* Replaces the mesh of one face: nodes inside it, projected onto it, and its triangles. */
void put_back(const surface &s, int face, const std::vector<std::uint32_t> &inside)
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

void put_back(const surface &s, const std::vector<std::uint8_t> &on_edges_by_tag)
{
    std::map<int, std::vector<std::uint32_t>> inside;
    std::vector<std::uint8_t> seen(s.points.size(), 0);
    for (std::size_t t = 0; t < s.triangles.size(); t++) {
        auto &of_face = inside[s.faces[t]];
        for (const std::uint32_t v : s.triangles[t]) {
            if (!seen[v] && !on_edges_by_tag[s.tags[v]]) {
                of_face.push_back(v);
            }
            seen[v] = 1;
        }
    }
    for (const auto &[face, vertices] : inside) {
        gmsh::model::mesh::clear({{2, face}});
    }
    for (const auto &[face, vertices] : inside) {
        put_back(s, face, vertices);
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

void improve_in_gmsh(int part)
{
    surface s = read_surface(part);
    std::vector<std::uint8_t> on_edges_by_tag(*std::max_element(s.tags.begin(), s.tags.end()) + 1, 0);
    for (std::size_t v = 0; v < s.tags.size(); v++) {
        on_edges_by_tag[s.tags[v]] = s.on_edges[v];
    }
    const qsmesh::report report = improve(s);
    std::printf("qsmesh: %zu moved, %zu tail triangles of which %zu are left, %zu vertices removed\n", report.moved,
                report.tails_before, report.tails_after, report.vertices_removed);
    put_back(s, on_edges_by_tag);
}

point minus(const point &a, const point &b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const point &a, const point &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
point cross(const point &a, const point &b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/* Smallest angle between two faces of a tetrahedron, degrees. */
double smallest_dihedral(const std::array<point, 4> &p)
{
    double smallest = 180;
    for (int i = 0; i < 4; i++) {
        for (int j = i + 1; j < 4; j++) {
            // The edge is that of the two other corners; the faces are seen along it.
            const int k = i == 0 ? (j == 1 ? 2 : 1) : 0;
            const int l = 6 - i - j - k;
            const point edge = minus(p[l], p[k]);
            const point a = cross(edge, minus(p[i], p[k])), b = cross(edge, minus(p[j], p[k]));
            const double cosine = dot(a, b) / std::sqrt(dot(a, a) * dot(b, b));
            smallest = std::min(smallest, std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::acos(-1.0));
        }
    }
    return smallest;
}

/* Mean ratio of a tetrahedron, 1 for a regular one, 0 for a flat one. */
double mean_ratio(const std::array<point, 4> &p)
{
    double squares = 0;
    for (int i = 0; i < 4; i++) {
        for (int j = i + 1; j < 4; j++) {
            squares += dot(minus(p[i], p[j]), minus(p[i], p[j]));
        }
    }
    const double volume = std::fabs(dot(cross(minus(p[1], p[0]), minus(p[2], p[0])), minus(p[3], p[0]))) / 6;
    return 12 * std::cbrt(9 * volume * volume) / squares;
}

void print_tetrahedra(const char *name)
{
    std::vector<std::size_t> tags, elements, nodes;
    std::vector<double> coordinates, parameters;
    gmsh::model::mesh::getNodes(tags, coordinates, parameters, -1, -1, false, false);
    std::unordered_map<std::size_t, point> at;
    for (std::size_t v = 0; v < tags.size(); v++) {
        at[tags[v]] = {coordinates[3 * v], coordinates[3 * v + 1], coordinates[3 * v + 2]};
    }
    gmsh::model::mesh::getElementsByType(TETRAHEDRON, elements, nodes);
    std::size_t below = 0;
    double angle = 180, ratio = 1, sum = 0;
    for (std::size_t i = 0; i < nodes.size(); i += 4) {
        const std::array<point, 4> corners{at[nodes[i]], at[nodes[i + 1]], at[nodes[i + 2]], at[nodes[i + 3]]};
        const double smallest = smallest_dihedral(corners), quality = mean_ratio(corners);
        below += smallest < 20;
        angle = std::min(angle, smallest);
        ratio = std::min(ratio, quality);
        sum += quality;
    }
    std::printf("%s: %zu tetrahedra, dihedral min %.2f, below 20: %zu, mean ratio min %.4f mean %.4f\n", name,
                elements.size(), angle, below, ratio, sum / static_cast<double>(elements.size()));
}

void print_surface(const char *name, int part)
{
    const surface s = read_surface(part);
    const qsmesh::measurement m = qsmesh::measure(s.points, s.triangles);
    std::printf("%s: %zu triangles, angle min %.2f, below 30: %zu, edge_ratio mean %.4f max %.3f, faults %zu\n", name,
                m.triangles, m.min_angle.min, m.below_30, m.edge_ratio.mean, m.edge_ratio.max,
                m.boundary_edges + m.non_manifold_edges);
}

void run(bool with_qsmesh)
{
    gmsh::model::add(with_qsmesh ? "with" : "without");
    const int part = make_part();
    mesh_surface();
    if (with_qsmesh) {
        improve_in_gmsh(part);
    }
    print_surface(with_qsmesh ? "surface with" : "surface without", part);
    gmsh::model::mesh::generate(3);
    print_tetrahedra(with_qsmesh ? "volume with" : "volume without");
}

} // namespace

int main()
{
    gmsh::initialize();
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.NumThreads", 1);
    run(false);
    run(true);
    gmsh::finalize();
    return 0;
}
