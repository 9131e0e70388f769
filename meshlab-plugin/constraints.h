// SPDX-License-Identifier: GPL-3.0-or-later
/// What the user wants to stay as it is: all outside the selection, texture seams, borders of face colours.
#ifndef QSMESH_CONSTRAINTS_H
#define QSMESH_CONSTRAINTS_H

#include <cstdint>
#include <vector>

#include <qsmesh.h>

#include "filters.h"
#include "host.h"
#include "layer.h"

namespace qsmesh {

/// Faces with more colours than this are taken to show a quality, not regions.
constexpr int MOST_REGION_COLOURS = 64;

/// Whether the faces have 2 to MOST_REGION_COLOURS colours.
bool coloursAreRegions(const CMeshO& mesh);

bool anythingSelected(const CMeshO& mesh);

struct Constraints {
    /// One byte a vertex, not 0 for those that must not move or go; or none.
    std::vector<uint8_t> vertexLock;
    /// One byte a triangle, 0 for those outside the selection; or none.
    std::vector<uint8_t> triangleMask;
    /// Two vertex numbers an edge that is to be kept.
    std::vector<uint32_t> edges;

    /// Lends everything to the options, which must not outlive it.
    void lendTo(qsm_options& options) const;
};

/// Throws MLException if only the selection is to be changed and there is none, or one that lets nothing move.
Constraints readConstraints(Filter filter, const RichParameterList& list, const CMeshO& mesh, const Packed& packed);

}  // namespace qsmesh

#endif
