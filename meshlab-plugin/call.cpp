// SPDX-License-Identifier: GPL-3.0-or-later
#include "call.h"

namespace qsmesh {

namespace {

/// The library's functions for a scalar type.
template <class Scalar>
struct Library;

template <>
struct Library<float> {
    static constexpr auto smooth = qsm_smooth_f32;
    static constexpr auto improve = qsm_improve_f32;
    static constexpr auto triangleQuality = qsm_triangle_quality_f32;
};

template <>
struct Library<double> {
    static constexpr auto smooth = qsm_smooth_f64;
    static constexpr auto improve = qsm_improve_f64;
    static constexpr auto triangleQuality = qsm_triangle_quality_f64;
};

constexpr size_t STRIDE = 3 * sizeof(Scalarm);

struct Progress {
    vcg::CallBackPos* callback;
    const char* doing;
    int percent;
};

extern "C" qsm_flow tellProgress(double done, void* user) {
    Progress& progress = *static_cast<Progress*>(user);
    const int percent = int(done * 100);
    // Each call redraws the host's window.
    if (percent == progress.percent) return QSM_CONTINUE;
    progress.percent = percent;
    try {
        return progress.callback(percent, progress.doing) ? QSM_CONTINUE : QSM_CANCEL;
    } catch (...) {
        // An exception must not pass through the library.
        return QSM_CANCEL;
    }
}

void check(qsm_status status, const qsm_report& report) {
    if (status != QSM_OK)
        throw MLException(QString::fromUtf8(*report.message ? report.message : qsm_status_string(status)));
}

void smooth(Packed& packed, const qsm_options& options, Outcome& outcome) {
    const qsm_status status =
        Library<Scalarm>::smooth(packed.positions.data(), packed.vertices.size(), STRIDE, packed.indices.data(),
                                 packed.indices.size(), &options, &outcome.report);
    check(status, outcome.report);
}

/// Makes room for whatever may come out.
qsm_maps prepareMaps(const Packed& packed, Outcome& outcome) {
    Sources& sources = outcome.sources;
    sources.vertices.resize(packed.vertices.size());
    sources.triangles.resize(packed.faces.size());
    sources.corners.resize(packed.indices.size());
    outcome.leftovers.resize(packed.faces.size());
    qsm_maps maps;
    qsm_maps_init(&maps);
    maps.vertex_source = sources.vertices.data();
    maps.triangle_source = sources.triangles.data();
    maps.corner_source = sources.corners.data();
    maps.leftovers = outcome.leftovers.data();
    maps.leftover_capacity = outcome.leftovers.size();
    return maps;
}

void improve(Packed& packed, const qsm_options& options, Outcome& outcome) {
    qsm_maps maps = prepareMaps(packed, outcome);
    size_t vertices = packed.vertices.size(), indices = packed.indices.size();
    const qsm_status status =
        Library<Scalarm>::improve(packed.positions.data(), &vertices, STRIDE, packed.indices.data(), &indices, &options,
                                  &maps, &outcome.report);
    check(status, outcome.report);
    packed.positions.resize(3 * vertices);
    packed.indices.resize(indices);
    outcome.sources.vertices.resize(vertices);
    outcome.sources.triangles.resize(indices / 3);
    outcome.sources.corners.resize(indices);
    outcome.leftovers.resize(maps.leftover_count);
}

}  // namespace

Outcome call(Filter filter, Packed& packed, qsm_options options, vcg::CallBackPos* callback) {
    Progress progress = {callback, describe(filter).doing, -1};
    if (callback) {
        options.progress = tellProgress;
        options.user = &progress;
    }
    Outcome outcome;
    qsm_report_init(&outcome.report);
    filter == SMOOTH ? smooth(packed, options, outcome) : improve(packed, options, outcome);
    return outcome;
}

std::vector<double> shapes(const Packed& packed) {
    std::vector<double> values(packed.indices.size() / 3);
    const qsm_status status =
        Library<Scalarm>::triangleQuality(packed.positions.data(), packed.positions.size() / 3, STRIDE,
                                          packed.indices.data(), packed.indices.size(), QSM_SHAPE, values.data());
    if (status != QSM_OK) throw MLException(qsm_status_string(status));
    return values;
}

}  // namespace qsmesh
