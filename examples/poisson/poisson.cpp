// What a solver gains: the Poisson equation with linear elements on a square plate with a hole, on meshes made by gmsh.
// One is graded towards the hole, as it comes; in the other the vertices have been scattered. Prints how many steps
// the conjugate gradients take and how far the solution is from the known one, without and with qsmesh.
#include "linear_elements.hpp"
#include "plate.hpp"

#include <Eigen/IterativeLinearSolvers>
#include <gmsh.h>
#include <qsmesh.hpp>

#include <cstdio>

namespace {

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
