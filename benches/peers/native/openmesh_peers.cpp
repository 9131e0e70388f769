// OpenMesh's Jacobi Laplace smoother, in tangential directions: what comes nearest there to smoothing along the
// surface.
#include "peer.hpp"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Smoother/JacobiLaplaceSmootherT.hh>

namespace {

struct Doubles : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
};
using Surface = OpenMesh::TriMesh_ArrayKernelT<Doubles>;
using Smoother = OpenMesh::Smoother::JacobiLaplaceSmootherT<Surface>;

class OpenMeshPeer : public Peer {
public:
    explicit OpenMeshPeer(const Mesh& mesh) : triangles(mesh.triangles) {
        surface.reserve(mesh.vertex_count(), 3 * mesh.triangle_count() / 2, mesh.triangle_count());
        for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
            const double* p = &mesh.positions[3 * v];
            surface.add_vertex({p[0], p[1], p[2]});
        }
    }

    void connect() override {
        for (std::size_t t = 0; t < triangles.size(); t += 3) {
            const auto corner = [&](std::size_t k) {
                return OpenMesh::VertexHandle(static_cast<int>(triangles[t + k]));
            };
            surface.add_face(corner(0), corner(1), corner(2));
        }
    }

    // The boundary stays, as elsewhere. Normals and weights are the smoother's own set-up.
    void smooth(unsigned iterations) override {
        surface.request_vertex_status();
        for (const auto v : surface.vertices()) surface.status(v).set_locked(surface.is_boundary(v));
        Smoother smoother(surface);
        smoother.initialize(Smoother::Tangential, Smoother::C0);
        smoother.smooth(iterations);
    }

    std::vector<double> positions() const override {
        std::vector<double> all;
        for (const auto v : surface.vertices()) {
            const auto& p = surface.point(v);
            all.insert(all.end(), {p[0], p[1], p[2]});
        }
        return all;
    }

private:
    Surface surface;
    std::vector<std::uint32_t> triangles;
};

} // namespace

std::vector<Entry> openmesh_entries() {
    return {{"OpenMesh tangential", [](const Mesh& mesh) { return std::make_unique<OpenMeshPeer>(mesh); }}};
}
