// SPDX-License-Identifier: GPL-3.0-or-later
#include "filters.h"

#include "host.h"

namespace qsmesh {

namespace {

#define QSMESH_PAPER                                                                                            \
    "<br>After: <i>O. Egorova, M. Savchenko, I. Hagiwara, V. Savchenko</i>, <b>\"Modeling of Quality Parameter " \
    "Values for Improving Meshes\"</b>, 2007."

constexpr Description DESCRIPTIONS[] = {
    {
        "Quasi-statistical smoothing",
        "apply_coord_quasi_statistical_smoothing",
        "Quasi-statistical smoothing...",
        "Makes thin triangles round by moving vertices, and keeps the surface: the connectivity stays, the enclosed "
        "volume stays exactly, creases and corners stay, and no star's worst triangle gets worse below a quality "
        "floor. Each vertex takes the statistics of the triangles around it, models better shapes for them, and goes "
        "where these shapes want it, in the tangent plane." QSMESH_PAPER,
    },
    {
        "Quasi-statistical improvement",
        "meshing_quasi_statistical_improvement",
        "Quasi-statistical improvement...",
        "Quasi-statistical smoothing, and then a cure for each triangle that stays bad, worst first: by moves, flips, "
        "and a few collapses and removals of vertices. Volume, creases, boundary and texture seams stay; all "
        "attributes are carried along." QSMESH_PAPER,
    },
};

#undef QSMESH_PAPER

}  // namespace

const Description& describe(int filter) {
    if (filter != SMOOTH && filter != IMPROVE)
        throw MLException("qsmesh has no filter number " + QString::number(filter));
    return DESCRIPTIONS[filter];
}

}  // namespace qsmesh
