// SPDX-License-Identifier: GPL-3.0-or-later
/// The filters' options: in the dialog, in filter scripts and in PyMeshLab on one side, qsm_options on the other.
#ifndef QSMESH_OPTIONS_H
#define QSMESH_OPTIONS_H

#include <qsmesh.h>

#include "filters.h"
#include "host.h"

namespace qsmesh {

/// Adds a filter's options. Defaults are the library's; those that depend on the mesh say so in their tooltips.
void addParameters(Filter filter, RichParameterList& list, const CMeshO& mesh);

/// The library's options but for what has to be read from the layer. Throws MLException for what the library could not
/// tell from a good value; it judges the rest itself.
qsm_options readOptions(Filter filter, const RichParameterList& list);

}  // namespace qsmesh

#endif
