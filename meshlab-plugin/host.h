// SPDX-License-Identifier: GPL-3.0-or-later
/// MeshLab's headers, and the names that its versions have for the same things.
///
/// QSMESH_MESHLAB_INTERFACE, set by the build from the MeshLab source tree, says which of the three interfaces that
/// tree has: 2020, 2022 or 2025.
#ifndef QSMESH_HOST_H
#define QSMESH_HOST_H

#if QSMESH_MESHLAB_INTERFACE == 2020
#include <common/interfaces.h>
#include <common/mlexception.h>
using RichPercentage = RichAbsPerc;
#else
#include <common/plugins/interfaces/filter_plugin.h>
#if QSMESH_MESHLAB_INTERFACE == 2022
using RichPercentage = RichAbsPerc;
#endif
#endif

#endif
