// A Laplacian over flat arrays: each vertex goes into the middle of its neighbours. It shows what reading and writing
// the memory costs, and what becomes of a surface that nobody looks after.
#include "peer.hpp"

namespace {

class Laplacian : public Peer {
public:
    explicit Laplacian(const Mesh& mesh) : mesh(mesh) {}

    void smooth(unsigned iterations) override {
        find_neighbours();
        for (unsigned i = 0; i < iterations; ++i) sweep();
    }

    std::vector<double> positions() const override { return mesh.positions; }

private:
    Mesh mesh;
    std::vector<std::uint32_t> starts, neighbours;
    std::vector<bool> fixed;

    // The next corner of each triangle at a vertex. On a boundary one neighbour is missing, but these vertices stay: an
    // edge lies on the boundary where it is gone along once only, which shows in the sums of what follows and precedes.
    void find_neighbours() {
        starts.assign(mesh.vertex_count() + 1, 0);
        std::vector<std::uint64_t> sums(mesh.vertex_count(), 0);
        for (const std::uint32_t v : mesh.triangles) ++starts[v + 1];
        for (std::size_t v = 0; v < mesh.vertex_count(); ++v) starts[v + 1] += starts[v];
        neighbours.resize(mesh.triangles.size());
        std::vector<std::uint32_t> next(starts.begin(), starts.end() - 1);
        for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t v = mesh.triangles[t + k], after = mesh.triangles[t + (k + 1) % 3];
                neighbours[next[v]++] = after;
                sums[v] += after - static_cast<std::uint64_t>(mesh.triangles[t + (k + 2) % 3]);
            }
        }
        fixed.resize(mesh.vertex_count());
        for (std::size_t v = 0; v < mesh.vertex_count(); ++v) fixed[v] = sums[v] != 0 || starts[v] == starts[v + 1];
    }

    void sweep() {
        double* const positions = mesh.positions.data();
        for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
            if (fixed[v]) continue;
            double sum[3] = {0, 0, 0};
            for (std::uint32_t i = starts[v]; i < starts[v + 1]; ++i) {
                for (int k = 0; k < 3; ++k) sum[k] += positions[3 * neighbours[i] + k];
            }
            const double share = 1.0 / (starts[v + 1] - starts[v]);
            for (int k = 0; k < 3; ++k) positions[3 * v + k] = sum[k] * share;
        }
    }
};

} // namespace

std::vector<Entry> plain_entries() {
    return {{"plain Laplacian, flat arrays", [](const Mesh& mesh) { return std::make_unique<Laplacian>(mesh); }}};
}
