// What a solver gains: the Poisson equation with linear elements on a square plate with a hole, on meshes made by gmsh.
// One is graded towards the hole, as it comes; in the other the vertices have been scattered. Prints how many steps
// the conjugate gradients take and how far the solution is from the known one, without and with qsmesh.
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <gmsh.h>
#include <qsmesh.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <unordered_map>

namespace {

using point = std::array<double, 3>;
using triangle = std::array<std::uint32_t, 3>;

constexpr int LINE = 1, TRIANGLE = 2;

struct mesh {
    std::vector<point> points;
    std::vector<triangle> triangles;
    /* 1 on the outer border and on that of the hole. */
    std::vector<std::uint8_t> on_border;
};

/* The plate -1..1 with a hole of radius 0.3; `size` is the edge length at its border, a sixth of that at the hole's. */
void describe_plate(double size)
{
    namespace occ = gmsh::model::occ;
    gmsh::clear();
    gmsh::model::add("plate");
    occ::addRectangle(-1, -1, 0, 2, 2, 1);
    occ::addDisk(0, 0, 0, 0.3, 0.3, 2);
    gmsh::vectorpair plate;
    std::vector<gmsh::vectorpair> map;
    occ::cut({{2, 1}}, {{2, 2}}, plate, map);
    occ::synchronize();
    gmsh::vectorpair corners, hole;
    gmsh::model::getEntities(corners, 0);
    gmsh::model::mesh::setSize(corners, size);
    gmsh::model::getEntitiesInBoundingBox(-0.4, -0.4, -0.1, 0.4, 0.4, 0.1, hole, 0);
    gmsh::model::mesh::setSize(hole, size / 6);
}

/* Nodes of all elements of a type, one element after the other. */
std::vector<std::size_t> nodes_of(int type)
{
    std::vector<std::size_t> elements, nodes;
    gmsh::model::mesh::getElementsByType(type, elements, nodes);
    return nodes;
}

mesh make_plate(double size)
{
    describe_plate(size);
    gmsh::option::setNumber("Mesh.Algorithm", 5);
    gmsh::model::mesh::generate(2);
    mesh m;
    std::vector<std::size_t> tags;
    std::vector<double> coordinates, parameters;
    gmsh::model::mesh::getNodes(tags, coordinates, parameters, -1, -1, false, false);
    std::unordered_map<std::size_t, std::uint32_t> numbers;
    for (std::size_t v = 0; v < tags.size(); v++) {
        m.points.push_back({coordinates[3 * v], coordinates[3 * v + 1], 0});
        numbers.emplace(tags[v], static_cast<std::uint32_t>(v));
    }
    const std::vector<std::size_t> corners = nodes_of(TRIANGLE);
    for (std::size_t i = 0; i < corners.size(); i += 3) {
        m.triangles.push_back({numbers[corners[i]], numbers[corners[i + 1]], numbers[corners[i + 2]]});
    }
    m.on_border.assign(m.points.size(), 0);
    for (const std::size_t node : nodes_of(LINE)) {
        m.on_border[numbers[node]] = 1;
    }
    return m;
}

double twice_area(const point &a, const point &b, const point &c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

double twice_area(const mesh &m, const triangle &t)
{
    return twice_area(m.points[t[0]], m.points[t[1]], m.points[t[2]]);
}

/* Shifts every inner vertex at random as far as no triangle around it turns over or gets flatter than `least`. */
void scatter(mesh &m, double least)
{
    std::vector<std::vector<std::size_t>> around(m.points.size());
    for (std::size_t t = 0; t < m.triangles.size(); t++) {
        for (const std::uint32_t v : m.triangles[t]) {
            around[v].push_back(t);
        }
    }
    std::mt19937 random(2007);
    const auto shift = [&random] { return static_cast<double>(random()) / 4294967296.0 - 0.5; };
    for (std::size_t v = 0; v < m.points.size(); v++) {
        double size = 0;
        for (const std::size_t t : around[v]) {
            size = std::max(size, std::sqrt(twice_area(m, m.triangles[t])));
        }
        const point from = m.points[v];
        const auto is_flat = [&](std::size_t t) { return twice_area(m, m.triangles[t]) < least * size * size; };
        for (double step = m.on_border[v] ? 0 : 2 * size; step > 0.01 * size; step *= 0.7) {
            m.points[v] = {from[0] + step * shift(), from[1] + step * shift(), 0};
            if (std::none_of(around[v].begin(), around[v].end(), is_flat)) {
                break;
            }
            m.points[v] = from;
        }
    }
}

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

struct equations {
    Eigen::SparseMatrix<double> matrix;
    Eigen::VectorXd right;
};

/* Linear elements; values on the border are those of the known solution. */
equations assemble(const mesh &m)
{
    const auto size = static_cast<Eigen::Index>(m.points.size());
    std::vector<Eigen::Triplet<double>> entries;
    equations e{Eigen::SparseMatrix<double>(size, size), Eigen::VectorXd::Zero(size)};
    for (const triangle &t : m.triangles) {
        const double area2 = twice_area(m, t);
        const auto g = gradients(m, t);
        const point &a = m.points[t[0]], &b = m.points[t[1]], &c = m.points[t[2]];
        const double middle = load((a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3);
        for (std::size_t i = 0; i < 3; i++) {
            if (m.on_border[t[i]]) {
                continue;
            }
            e.right[t[i]] += area2 / 6 * middle;
            for (std::size_t j = 0; j < 3; j++) {
                const double value = (g[i][0] * g[j][0] + g[i][1] * g[j][1]) / (2 * area2);
                if (m.on_border[t[j]]) {
                    e.right[t[i]] -= value * solution(m.points[t[j]][0], m.points[t[j]][1]);
                } else {
                    entries.emplace_back(t[i], t[j], value);
                }
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

/* L2 norm of the error, by a rule that is exact for polynomials of degree 2. */
double error_of(const mesh &m, const Eigen::VectorXd &u)
{
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

template <typename Preconditioner> long solve(const equations &e, Eigen::VectorXd &u)
{
    Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper, Preconditioner> solver;
    solver.setTolerance(1e-10);
    u = solver.compute(e.matrix).solve(e.right);
    return static_cast<long>(solver.iterations());
}

void print_solved(const char *name, const mesh &m)
{
    const equations e = assemble(m);
    Eigen::VectorXd u;
    const long plain = solve<Eigen::IdentityPreconditioner>(e, u);
    const long incomplete = solve<Eigen::IncompleteCholesky<double>>(e, u);
    const qsmesh::measurement q = qsmesh::measure(m.points, m.triangles);
    std::printf("%s: %zu vertices, angle min %.2f, iterations %ld plain %ld preconditioned, error %.4e\n", name,
                q.vertices, q.min_angle.min, plain, incomplete, error_of(m, u));
}

/* Border vertices keep their places; everything stays in the plane. */
void improve(mesh &m)
{
    qsmesh::options options;
    qsmesh::maps from;
    options.tail_min_angle = 30;
    options.tail_max_angle = 110;
    options.lock(m.on_border);
    qsmesh::improve(m.points, m.triangles, options, from);
    std::vector<std::uint8_t> on_border;
    for (const std::uint32_t v : from.vertex_source) {
        on_border.push_back(m.on_border[v]);
    }
    m.on_border = on_border;
}

void compare(const std::string &name, mesh m)
{
    print_solved((name + " before").c_str(), m);
    improve(m);
    print_solved((name + " after").c_str(), m);
}

} // namespace

int main()
{
    gmsh::initialize();
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.NumThreads", 1);
    mesh plate = make_plate(0.06);
    compare("graded", plate);
    scatter(plate, 0.02);
    compare("scattered", plate);
    gmsh::finalize();
    return 0;
}
