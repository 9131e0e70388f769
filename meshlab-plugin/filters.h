// SPDX-License-Identifier: GPL-3.0-or-later
/// The filters and what they say of themselves.
#ifndef QSMESH_FILTERS_H
#define QSMESH_FILTERS_H

namespace qsmesh {

enum Filter { SMOOTH, IMPROVE };

struct Description {
    /// In the menu, and in filter scripts.
    const char* name;
    /// In PyMeshLab.
    const char* pythonName;
    /// Beside the progress bar.
    const char* doing;
    const char* info;
};

/// Throws MLException for a number that is no filter's.
const Description& describe(int filter);

}  // namespace qsmesh

#endif
