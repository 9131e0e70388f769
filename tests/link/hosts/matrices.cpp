// Eigen's matrices as buffers of the C++ header.
#include <Eigen/Core>
#include <qsmesh.hpp>

#include "check.h"
#include "torus.h"

#include <cstring>

namespace {

using points_by_rows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
using points_by_columns = Eigen::Matrix<double, 3, Eigen::Dynamic>;
using scattered = Eigen::Matrix<double, Eigen::Dynamic, 3>;
using triangles_by_rows = Eigen::Matrix<std::uint32_t, Eigen::Dynamic, 3, Eigen::RowMajor>;

static_assert(qsmesh::detail::in_order<points_by_rows> && qsmesh::detail::in_order<const points_by_columns &>);
static_assert(!qsmesh::detail::in_order<scattered>, "its coordinates lie far apart, so it is refused");
static_assert(qsmesh::detail::in_order<Eigen::VectorXd> && qsmesh::detail::in_order<std::vector<double>>);

} // namespace

int main()
{
    points_by_rows rows(TORUS_VERTICES, 3);
    triangles_by_rows triangles(TORUS_INDICES / 3, 3);
    torus(rows.data(), triangles.data());
    points_by_columns columns = rows.transpose();
    Eigen::VectorXd expected = Eigen::Map<Eigen::VectorXd>(rows.data(), rows.size());
    CHECK(qsm_smooth_f64(expected.data(), TORUS_VERTICES, 24, triangles.data(), TORUS_INDICES, nullptr, nullptr) == QSM_OK);
    qsmesh::smooth(rows, triangles);
    qsmesh::smooth(columns, triangles);
    CHECK(std::memcmp(rows.data(), expected.data(), sizeof(double) * 3 * TORUS_VERTICES) == 0);
    CHECK(std::memcmp(columns.data(), expected.data(), sizeof(double) * 3 * TORUS_VERTICES) == 0);
    return 0;
}
