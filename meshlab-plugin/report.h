// SPDX-License-Identifier: GPL-3.0-or-later
/// The library's report as figures by name for scripts, and as lines for the log.
#ifndef QSMESH_REPORT_H
#define QSMESH_REPORT_H

#include <map>
#include <string>
#include <vector>

#include <QVariant>

#include "call.h"
#include "filters.h"

namespace qsmesh {

/// What PyMeshLab gives to a script: numbers, each under the library's name for it.
std::map<std::string, QVariant> outputValues(Filter filter, const Outcome& outcome);

std::vector<std::string> logLines(Filter filter, const Outcome& outcome);

}  // namespace qsmesh

#endif
