// The Poisson equation with a known solution, by linear elements.
#ifndef LINEAR_ELEMENTS_HPP
#define LINEAR_ELEMENTS_HPP

#include "plate.hpp"

#include <Eigen/SparseCore>

struct equations {
    Eigen::SparseMatrix<double> matrix;
    Eigen::VectorXd right;
};

/* One equation a vertex. Values on the border are those of the known solution. */
equations assemble(const mesh &m);

/* L2 norm of the error of a solution by vertices. */
double error_of(const mesh &m, const Eigen::VectorXd &u);

#endif
