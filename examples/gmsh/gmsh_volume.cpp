// Meshes a CAD part with gmsh: its surface, then its volume; once as it is, and once with qsmesh between the two.
// Prints what surface and tetrahedra are like. CAD edges are handed over as features and their nodes stay where they
// are, as the lines between them belong to the CAD model; all other nodes are put back onto the CAD surface.
#include "surface.hpp"
#include "tetrahedra.hpp"

#include <gmsh.h>
#include <qsmesh.hpp>

#include <cstdio>

namespace {

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

/* CAD knows its edges, so none are to be found by angle. Tags and faces are brought along. */
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
        s.on_edges[v] = s.on_edges[maps.vertex_source[v]];
    }
    s.tags.resize(s.points.size());
    s.on_edges.resize(s.points.size());
    std::vector<int> faces;
    for (const std::uint32_t from : maps.triangle_source) {
        faces.push_back(s.faces[from]);
    }
    s.faces = faces;
    return report;
}

void improve_in_gmsh(int part)
{
    surface s = read_surface(part);
    const qsmesh::report report = improve(s);
    std::printf("qsmesh: %zu moved, %zu tail triangles of which %zu are left, %zu vertices removed\n", report.moved,
                report.tails_before, report.tails_after, report.vertices_removed);
    write_surface(s);
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
