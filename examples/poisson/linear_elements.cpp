#include "linear_elements.hpp"

#include <cmath>

namespace {

/* The known solution, and the load that belongs to it. */
double solution(double x, double y) { return std::sin(2 * x) * std::cosh(y) + x * x * y; }
double load(double x, double y) { return 3 * std::sin(2 * x) * std::cosh(y) - 2 * y; }

/* Gradients of the three linear shape functions times twice the area. */
std::array<std::array<double, 2>, 3> gradients(const mesh &m, const triangle &t)
{
    std::array<std::array<double, 2>, 3> g;
    for (std::size_t k = 0; k < 3; k++) {
        const point &b = m.points[t[(k + 1) % 3]], &c = m.points[t[(k + 2) % 3]];
        g[k] = {b[1] - c[1], c[0] - b[0]};
    }
    return g;
}

/* What one triangle adds to the equation of its corner `i`. */
void add_row(const mesh &m, const triangle &t, std::size_t i, std::vector<Eigen::Triplet<double>> &entries,
             Eigen::VectorXd &right)
{
    const double area2 = twice_area(m, t);
    const auto g = gradients(m, t);
    const point &a = m.points[t[0]], &b = m.points[t[1]], &c = m.points[t[2]];
    right[t[i]] += area2 / 6 * load((a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3);
    for (std::size_t j = 0; j < 3; j++) {
        const double value = (g[i][0] * g[j][0] + g[i][1] * g[j][1]) / (2 * area2);
        if (m.on_border[t[j]]) {
            right[t[i]] -= value * solution(m.points[t[j]][0], m.points[t[j]][1]);
        } else {
            entries.emplace_back(t[i], t[j], value);
        }
    }
}

} // namespace

equations assemble(const mesh &m)
{
    const auto size = static_cast<Eigen::Index>(m.points.size());
    std::vector<Eigen::Triplet<double>> entries;
    equations e{Eigen::SparseMatrix<double>(size, size), Eigen::VectorXd::Zero(size)};
    for (const triangle &t : m.triangles) {
        for (std::size_t i = 0; i < 3; i++) {
            if (!m.on_border[t[i]]) {
                add_row(m, t, i, entries, e.right);
            }
        }
    }
    for (std::uint32_t v = 0; v < m.points.size(); v++) {
        if (m.on_border[v]) {
            entries.emplace_back(v, v, 1);
            e.right[v] = solution(m.points[v][0], m.points[v][1]);
        }
    }
    e.matrix.setFromTriplets(entries.begin(), entries.end());
    return e;
}

double error_of(const mesh &m, const Eigen::VectorXd &u)
{
    // By the middles of the edges, which is exact for polynomials of degree 2.
    double sum = 0;
    for (const triangle &t : m.triangles) {
        for (std::size_t k = 0; k < 3; k++) {
            const point &a = m.points[t[k]], &b = m.points[t[(k + 1) % 3]];
            const double exact = solution((a[0] + b[0]) / 2, (a[1] + b[1]) / 2);
            const double difference = (u[t[k]] + u[t[(k + 1) % 3]]) / 2 - exact;
            sum += twice_area(m, t) / 6 * difference * difference;
        }
    }
    return std::sqrt(sum);
}
