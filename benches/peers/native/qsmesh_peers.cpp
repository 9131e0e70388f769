// qsmesh through its C interface, on the caller's buffers in place. Nothing is built beforehand: checking the buffers
// and finding the stars belongs to the call.
#include "peer.hpp"

#include <qsmesh.h>

#include <stdexcept>

namespace {

class Qsmesh : public Peer {
public:
    Qsmesh(const Mesh& mesh, double feature_angle, std::uint32_t threads) : mesh(mesh) {
        qsm_options_init(&options);
        options.feature_angle = feature_angle;
        options.threads = threads;
    }

    void smooth(unsigned iterations) override {
        options.iterations = iterations;
        const qsm_status status = qsm_smooth_f64(mesh.positions.data(), mesh.vertex_count(), 3 * sizeof(double),
                                                 mesh.triangles.data(), mesh.triangles.size(), &options, nullptr);
        if (status != QSM_OK) throw std::runtime_error(qsm_status_string(status));
    }

    std::vector<double> positions() const override { return mesh.positions; }

private:
    Mesh mesh;
    qsm_options options;
};

Entry entry(const char* name, double feature_angle, std::uint32_t threads) {
    return {name, [=](const Mesh& mesh) { return std::make_unique<Qsmesh>(mesh, feature_angle, threads); }};
}

} // namespace

std::vector<Entry> qsmesh_entries() {
    return {entry("qsmesh", 30, 1), entry("qsmesh, features off", 0, 1), entry("qsmesh, all threads", 30, 0)};
}
