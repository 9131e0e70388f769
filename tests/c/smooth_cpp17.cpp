// The interface as a C++ host uses it: a vector of vertices with attributes, a lambda for progress.
#include "qsmesh.h"

#include "check.h"
#include "torus.h"

#include <cmath>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace {

template <typename T> struct Vertex {
    T position[3];
    T normal[3];
    T texture[2];

    bool same_attributes(const Vertex &other) const
    {
        return std::memcmp(normal, other.normal, sizeof normal) == 0 &&
               std::memcmp(texture, other.texture, sizeof texture) == 0;
    }
};

static_assert(sizeof(Vertex<float>) == 32);
static_assert(std::is_same_v<decltype(qsm_smooth_f32(nullptr, 0, 12, nullptr, 0, nullptr, nullptr)), qsm_status>);

template <typename T> struct Mesh {
    std::vector<Vertex<T>> vertices{TORUS_VERTICES};
    std::vector<std::uint32_t> indices = std::vector<std::uint32_t>(TORUS_INDICES);

    Mesh()
    {
        std::vector<double> positions(3 * TORUS_VERTICES);
        torus(positions.data(), indices.data());
        for (std::size_t v = 0; v < vertices.size(); v++) {
            for (std::size_t k = 0; k < 3; k++) {
                vertices[v].position[k] = static_cast<T>(positions[3 * v + k]);
                vertices[v].normal[k] = static_cast<T>(v);
            }
            vertices[v].texture[0] = vertices[v].texture[1] = static_cast<T>(0.25);
        }
    }

    double volume() const
    {
        std::vector<double> positions;
        for (const auto &vertex : vertices) {
            positions.insert(positions.end(), vertex.position, vertex.position + 3);
        }
        return torus_volume(positions.data(), indices.data());
    }

    bool same_bits(const Mesh &other) const
    {
        return std::memcmp(vertices.data(), other.vertices.data(), vertices.size() * sizeof(Vertex<T>)) == 0 &&
               indices == other.indices;
    }
};

qsm_status smooth(Mesh<float> &mesh, const qsm_options *options, qsm_report *report)
{
    return qsm_smooth_f32(mesh.vertices.data()->position, mesh.vertices.size(), sizeof(Vertex<float>),
                          mesh.indices.data(), mesh.indices.size(), options, report);
}

qsm_status smooth(Mesh<double> &mesh, const qsm_options *options, qsm_report *report)
{
    return qsm_smooth_f64(mesh.vertices.data()->position, mesh.vertices.size(), sizeof(Vertex<double>),
                          mesh.indices.data(), mesh.indices.size(), options, report);
}

template <typename T> void improves_and_leaves_attributes(double bound)
{
    const Mesh<T> before;
    Mesh<T> mesh;
    qsm_report report;
    qsm_report_init(&report);
    CHECK(smooth(mesh, nullptr, &report) == QSM_OK);
    CHECK(report.moved > 0);
    CHECK(report.after.edge_ratio.mean < report.before.edge_ratio.mean);
    CHECK(!mesh.same_bits(before));
    CHECK(std::fabs(mesh.volume() - before.volume()) <= bound * before.volume());
    for (std::size_t v = 0; v < mesh.vertices.size(); v++) {
        CHECK(mesh.vertices[v].same_attributes(before.vertices[v]));
    }
}

template <typename T> void a_lambda_cancels()
{
    const Mesh<T> before;
    Mesh<T> mesh;
    int left = 2;
    qsm_options options;
    qsm_report report;
    qsm_options_init(&options);
    qsm_report_init(&report);
    options.user = &left;
    options.progress = [](double, void *user) -> qsm_flow {
        return --*static_cast<int *>(user) > 0 ? QSM_CONTINUE : QSM_CANCEL;
    };
    CHECK(smooth(mesh, &options, &report) == QSM_CANCELLED);
    CHECK(left == 0);
    CHECK(mesh.same_bits(before));
    CHECK(std::string(report.message) == "cancelled by the progress callback");
}

template <typename T> void a_bad_triangle_is_named()
{
    Mesh<T> mesh;
    mesh.indices[3 * 100] = 0xFFFFFFFFu;
    const Mesh<T> before = mesh;
    qsm_report report;
    qsm_report_init(&report);
    CHECK(smooth(mesh, nullptr, &report) == QSM_INDEX_OUT_OF_RANGE);
    CHECK(report.offender == 100);
    CHECK(std::string(report.offender_name) == "indices");
    CHECK(mesh.same_bits(before));
}

} // namespace

int main()
{
    improves_and_leaves_attributes<float>(1e-6);
    improves_and_leaves_attributes<double>(1e-12);
    a_lambda_cancels<float>();
    a_lambda_cancels<double>();
    a_bad_triangle_is_named<float>();
    a_bad_triangle_is_named<double>();
    return 0;
}
