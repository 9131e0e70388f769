// SPDX-License-Identifier: GPL-3.0-or-later
/// Calls of the library, in the scalar type of the host.
#ifndef QSMESH_CALL_H
#define QSMESH_CALL_H

#include <vector>

#include <qsmesh.h>

#include "filters.h"
#include "host.h"
#include "layer.h"

namespace qsmesh {

struct Outcome {
    qsm_report report;
    /// Empty after smoothing.
    Sources sources;
    /// By their numbers among the triangles that came out.
    std::vector<qsm_leftover> leftovers;
};

/// Improves packed positions and, with IMPROVE, indices. Throws MLException with the library's message; packed is then
/// as it was.
Outcome call(Filter filter, Packed& packed, qsm_options options, vcg::CallBackPos* callback);

/// The mean-ratio shape of each packed triangle.
std::vector<double> shapes(const Packed& packed);

}  // namespace qsmesh

#endif
