// CGAL's two smoothings that move vertices along the surface, with their defaults but for flips and projection.
#include "peer.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/angle_and_area_smoothing.h>
#include <CGAL/Polygon_mesh_processing/tangential_relaxation.h>
#include <CGAL/Surface_mesh.h>

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
namespace parameters = CGAL::parameters;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

class CgalPeer : public Peer {
public:
    explicit CgalPeer(const Mesh& mesh) : triangles(mesh.triangles) {
        surface.reserve(mesh.vertex_count(), 3 * mesh.triangle_count() / 2, mesh.triangle_count());
        for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
            const double* p = &mesh.positions[3 * v];
            surface.add_vertex(Kernel::Point_3(p[0], p[1], p[2]));
        }
    }

    void connect() override {
        for (std::size_t t = 0; t < triangles.size(); t += 3) {
            const std::uint32_t* corners = &triangles[t];
            surface.add_face(Surface::Vertex_index(corners[0]), Surface::Vertex_index(corners[1]),
                             Surface::Vertex_index(corners[2]));
        }
    }

    std::vector<double> positions() const override {
        std::vector<double> all;
        for (const auto v : surface.vertices()) {
            const auto& p = surface.point(v);
            all.insert(all.end(), {p.x(), p.y(), p.z()});
        }
        return all;
    }

protected:
    Surface surface;
    std::vector<std::uint32_t> triangles;
};

class Relaxation : public CgalPeer {
public:
    using CgalPeer::CgalPeer;
    void smooth(unsigned iterations) override {
        pmp::tangential_relaxation(vertices(surface), surface, parameters::number_of_iterations(iterations));
    }
};

// Flips are off because connectivity is to stay; projection back onto the surface is on only where it is asked for.
class AngleSmoothing : public CgalPeer {
public:
    AngleSmoothing(const Mesh& mesh, bool projects) : CgalPeer(mesh), projects(projects) {}
    void smooth(unsigned iterations) override {
        pmp::angle_and_area_smoothing(surface, parameters::number_of_iterations(iterations)
                                                   .use_angle_smoothing(true)
                                                   .use_area_smoothing(false)
                                                   .use_Delaunay_flips(false)
                                                   .use_safety_constraints(false)
                                                   .do_project(projects));
    }

private:
    bool projects;
};

} // namespace

std::vector<Entry> cgal_entries() {
    return {
        {"CGAL tangential_relaxation", [](const Mesh& mesh) { return std::make_unique<Relaxation>(mesh); }},
        {"CGAL angle smoothing", [](const Mesh& mesh) { return std::make_unique<AngleSmoothing>(mesh, false); }},
        {"CGAL angle smoothing, projected",
         [](const Mesh& mesh) { return std::make_unique<AngleSmoothing>(mesh, true); }},
    };
}
