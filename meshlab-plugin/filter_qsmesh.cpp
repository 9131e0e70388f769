// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_qsmesh.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <new>
#include <vector>

#include <qsmesh.h>

#if QSMESH_MESHLAB_INTERFACE != 2025
using RichPercentage = RichAbsPerc;
#endif

namespace {

enum Filter { SMOOTH };

struct Description {
    const char* name;
    const char* pythonName;
    const char* info;
};

const Description& describe(int filter) {
    static const Description smooth = {
        "Quasi-statistical smoothing",
        "apply_coord_quasi_statistical_smoothing",
        "Makes thin triangles round by moving vertices, and keeps the surface: the connectivity stays, the enclosed "
        "volume stays exactly, creases and corners stay, and no star's worst triangle gets worse below a quality "
        "floor. Each vertex takes the statistics of the triangles around it, models better shapes for them, and goes "
        "where these shapes want it, in the tangent plane.<br>After: <i>O. Egorova, M. Savchenko, I. Hagiwara, "
        "V. Savchenko</i>, <b>\"Modeling of Quality Parameter Values for Improving Meshes\"</b>, 2007.",
    };
    if (filter != SMOOTH) throw MLException("qsmesh has no filter number " + QString::number(filter));
    return smooth;
}

// ---- options ----

/// An option for experts; MeshLab 2022.02 and later show it on request only.
RichFloat expert(const char* name, double value, const char* label, const QString& tip) {
#if QSMESH_MESHLAB_INTERFACE == 2020
    return RichFloat(name, value, label, tip);
#else
    return RichFloat(name, value, label, tip, true);
#endif
}

bool anythingSelected(const CMeshO& mesh) {
    for (const auto& vertex : mesh.vert)
        if (!vertex.IsD() && vertex.IsS()) return true;
    for (const auto& face : mesh.face)
        if (!face.IsD() && face.IsS()) return true;
    return false;
}

qsm_options defaults() {
    qsm_options options;
    qsm_options_init(&options);
    return options;
}

void addScope(RichParameterList& list, const CMeshO& mesh) {
    list.addParam(RichBool("selected", anythingSelected(mesh), "Affect only selection",
                           "Moves only the selected vertices or, if no vertex is selected, the vertices all of whose "
                           "faces are selected. Default: on if anything is selected."));
    list.addParam(RichEnum("boundary", defaults().boundary, {"fixed", "slide"}, "Boundary",
                           "Vertices on the boundary of an open mesh: fixed, or sliding along the boundary, whose "
                           "corners stay. Default: fixed."));
}

void addMethod(RichParameterList& list) {
    const qsm_options given = defaults();
    list.addParam(RichInt("iterations", int(given.iterations), "Iterations",
                          QString("Sweeps over the mesh, 0 to 10000. Default: %1.").arg(given.iterations)));
    list.addParam(RichFloat("relaxation", given.relaxation, "Relaxation",
                            QString("Over-relaxation of each move, a factor above 0 and at most 2; 1 is the setting of "
                                    "the original method. Default: %1.")
                                .arg(given.relaxation)));
    list.addParam(RichEnum("plane", given.plane, {"vector area", "least squares"}, "Tangent plane",
                           "Plane into which the triangles around a vertex are projected: orthogonal to the vector "
                           "area of the ring, or the least-squares plane of its vertices. Default: vector area."));
    list.addParam(RichEnum("ideal", given.ideal, {"modelled", "equilateral"}, "Ideal shape",
                           "Shape asked of the triangles: modelled from the statistics of the triangles around the "
                           "vertex, or equilateral. Default: modelled."));
}

void addKept(RichParameterList& list, const CMeshO& mesh) {
    const qsm_options given = defaults();
    list.addParam(RichBool("features", given.feature_angle > 0, "Keep features",
                           "Keeps creases and their corners, told from noise by the library. Default: on."));
    list.addParam(RichFloat("feature_angle", given.feature_angle, "Feature angle (degrees)",
                            QString("Dihedral angle above which an edge may be a crease, degrees, above 0 and below "
                                    "180. Counts only with Keep features. Default: %1.")
                                .arg(given.feature_angle)));
    const double diagonal = mesh.bbox.IsNull() ? 0 : double(mesh.bbox.Diag());
    list.addParam(RichPercentage("max_deviation", 0, 0, std::isfinite(diagonal) ? diagonal : 0, "Greatest deviation",
                                 "Greatest distance of a vertex from the original surface, in the units of the "
                                 "coordinates or in percent of the bounding box's diagonal, from 0; 0: no bound. "
                                 "Default: 0."));
}

void addExpert(RichParameterList& list) {
    const qsm_options given = defaults();
    list.addParam(expert("quality_floor", given.quality_floor, "Quality floor",
                         QString("Mean-ratio shape (0 no area, 1 equilateral) below which no star's worst triangle may "
                                 "fall, or fall further, 0 to 1. Default: %1.")
                             .arg(given.quality_floor)));
    list.addParam(expert("interval_width", given.interval_width, "Interval width",
                         QString("Interval width of the sampling histogram, in units of edge ratio, 0.001 to 1000. "
                                 "Default: %1.")
                             .arg(given.interval_width)));
    list.addParam(expert("sample_limit", given.sample_limit, "Sample limit",
                         QString("Edge ratio above which a sample counts as this one, at least 1. Default: %1.")
                             .arg(given.sample_limit)));
}

void addOutput(RichParameterList& list) {
    list.addParam(RichBool("face_quality", false, "Write per-face quality",
                           "Stores the mean-ratio shape of each triangle (0 no area, 1 equilateral) as its quality, "
                           "for MeshLab's colorize filters. Default: off."));
}

void addParameters(int filter, RichParameterList& list, const CMeshO& mesh) {
    describe(filter);
    addScope(list, mesh);
    addMethod(list);
    addKept(list, mesh);
    addExpert(list);
    addOutput(list);
}

/// The value that was meant: a host in single precision makes 1.2 into 1.2000000477, which would be another option than
/// everywhere else. The shortest decimal of the float is what somebody typed.
template <class Scalar>
double meant(Scalar value) {
    char text[64];
    double result = value;
    const auto end = std::to_chars(text, text + sizeof text, value).ptr;
    std::from_chars(text, end, result);
    return result;
}

uint32_t iterations(const RichParameterList& list) {
    const int given = list.getInt("iterations");
    if (given < 0) throw MLException(QString("iterations is %1, not in 0 to 10000").arg(given));
    return uint32_t(given);
}

double featureAngle(const RichParameterList& list) {
    if (!list.getBool("features")) return 0;
    const double given = meant(list.getFloat("feature_angle"));
    // The library's 0 would quietly mean no features.
    if (given == 0) throw MLException("feature_angle is 0, not above 0; switch off Keep features instead");
    return given;
}

qsm_options readOptions(const RichParameterList& list) {
    qsm_options options = defaults();
    options.iterations = iterations(list);
    options.relaxation = meant(list.getFloat("relaxation"));
    options.plane = list.getEnum("plane");
    options.ideal = list.getEnum("ideal");
    options.boundary = list.getEnum("boundary");
    options.feature_angle = featureAngle(list);
    const double deviation = meant(list.getAbsPerc("max_deviation"));
    options.max_deviation = deviation == 0 ? HUGE_VAL : deviation;
    options.quality_floor = meant(list.getFloat("quality_floor"));
    options.interval_width = meant(list.getFloat("interval_width"));
    options.sample_limit = meant(list.getFloat("sample_limit"));
    return options;
}

// ---- mesh ----

/// The elements of a layer that are not deleted, numbered from 0 in their order, as the library wants them. The layer is
/// left as it is: its deleted elements stay where they are.
struct Packed {
    /// x, y, z of each vertex.
    std::vector<Scalarm> positions;
    /// Three vertex numbers a triangle.
    std::vector<uint32_t> indices;
    std::vector<CVertexO*> vertices;
    std::vector<CFaceO*> faces;
};

constexpr uint32_t DELETED = UINT32_MAX;

/// Packs the vertices; returns the packed number of each vertex of the layer, DELETED for a deleted one.
std::vector<uint32_t> packVertices(CMeshO& mesh, Packed& packed) {
    std::vector<uint32_t> numbers(mesh.vert.size(), DELETED);
    for (auto& vertex : mesh.vert) {
        if (vertex.IsD()) continue;
        numbers[vcg::tri::Index(mesh, vertex)] = uint32_t(packed.vertices.size());
        packed.vertices.push_back(&vertex);
        for (int axis = 0; axis < 3; ++axis) packed.positions.push_back(vertex.cP()[axis]);
    }
    return numbers;
}

Packed pack(CMeshO& mesh) {
    Packed packed;
    const std::vector<uint32_t> numbers = packVertices(mesh, packed);
    for (auto& face : mesh.face) {
        if (face.IsD()) continue;
        packed.faces.push_back(&face);
        for (int corner = 0; corner < 3; ++corner) {
            const uint32_t number = numbers[vcg::tri::Index(mesh, face.cV(corner))];
            if (number == DELETED) throw MLException("a face of the layer names a deleted vertex");
            packed.indices.push_back(number);
        }
    }
    if (packed.vertices.empty()) throw MLException("the layer is empty: there are no triangles to improve");
    if (packed.faces.empty()) throw MLException("the layer is a point cloud: there are no triangles to improve");
    return packed;
}

/// Locks every vertex that is not selected.
std::vector<uint8_t> lockOutsideVertices(const Packed& packed) {
    std::vector<uint8_t> lock;
    for (const CVertexO* vertex : packed.vertices) lock.push_back(!vertex->IsS());
    return lock;
}

/// Locks every vertex that has a face that is not selected, or no face.
std::vector<uint8_t> lockOutsideFaces(const Packed& packed) {
    std::vector<uint8_t> lock(packed.vertices.size(), 1);
    for (const bool selected : {true, false})
        for (size_t face = 0; face < packed.faces.size(); ++face)
            for (int corner = 0; corner < 3 && packed.faces[face]->IsS() == selected; ++corner)
                lock[packed.indices[3 * face + corner]] = !selected;
    return lock;
}

bool allLocked(const std::vector<uint8_t>& lock) {
    for (const uint8_t locked : lock)
        if (!locked) return false;
    return true;
}

/// One byte a vertex, 0 for those that the selection lets move.
std::vector<uint8_t> lockUnselected(const CMeshO& mesh, const Packed& packed) {
    if (!anythingSelected(mesh))
        throw MLException("nothing is selected: select vertices or faces, or switch off Affect only selection");
    std::vector<uint8_t> lock = lockOutsideVertices(packed);
    if (allLocked(lock)) lock = lockOutsideFaces(packed);
    if (allLocked(lock)) throw MLException("no vertex has all its faces selected: select more faces, or vertices");
    return lock;
}

void unpack(const Packed& packed) {
    for (size_t vertex = 0; vertex < packed.vertices.size(); ++vertex) {
        const Scalarm* position = &packed.positions[3 * vertex];
        packed.vertices[vertex]->P() = Point3m(position[0], position[1], position[2]);
    }
}

void updateBoxAndNormals(MeshModel& model) {
#if QSMESH_MESHLAB_INTERFACE == 2020
    model.UpdateBoxAndNormals();
#else
    model.updateBoxAndNormals();
#endif
}

// ---- library ----

/// The library's functions for a scalar type.
template <class Scalar>
struct Library;

template <>
struct Library<float> {
    static constexpr auto smooth = qsm_smooth_f32;
    static constexpr auto measure = qsm_measure_f32;
};

template <>
struct Library<double> {
    static constexpr auto smooth = qsm_smooth_f64;
    static constexpr auto measure = qsm_measure_f64;
};

constexpr size_t STRIDE = 3 * sizeof(Scalarm);

struct Progress {
    vcg::CallBackPos* callback;
    int percent;
};

extern "C" qsm_flow tellProgress(double done, void* user) {
    Progress& progress = *static_cast<Progress*>(user);
    const int percent = int(done * 100);
    // Each call redraws the host's window.
    if (percent == progress.percent) return QSM_CONTINUE;
    progress.percent = percent;
    try {
        return progress.callback(percent, "Quasi-statistical smoothing...") ? QSM_CONTINUE : QSM_CANCEL;
    } catch (...) {
        // An exception must not pass through the library.
        return QSM_CANCEL;
    }
}

void check(qsm_status status, const qsm_report& report) {
    if (status != QSM_OK)
        throw MLException(QString::fromUtf8(*report.message ? report.message : qsm_status_string(status)));
}

/// Improves the packed positions.
qsm_report improve(Packed& packed, qsm_options options, vcg::CallBackPos* callback) {
    Progress progress = {callback, -1};
    if (callback) {
        options.progress = tellProgress;
        options.user = &progress;
    }
    qsm_report report;
    qsm_report_init(&report);
    const qsm_status status =
        Library<Scalarm>::smooth(packed.positions.data(), packed.vertices.size(), STRIDE, packed.indices.data(),
                                 packed.indices.size(), &options, &report);
    check(status, report);
    return report;
}

double shape(const Packed& packed, size_t face) {
    static const uint32_t indices[3] = {0, 1, 2};
    Scalarm corners[9];
    for (int k = 0; k < 9; ++k) corners[k] = packed.positions[3 * packed.indices[3 * face + k / 3] + k % 3];
    qsm_measurement measurement;
    qsm_measurement_init(&measurement);
    const qsm_status status = Library<Scalarm>::measure(corners, 3, STRIDE, indices, 3, &measurement);
    if (status != QSM_OK) throw MLException(qsm_status_string(status));
    return measurement.shape.mean;
}

std::vector<Scalarm> shapes(const Packed& packed) {
    std::vector<Scalarm> result;
    for (size_t face = 0; face < packed.faces.size(); ++face) result.push_back(Scalarm(shape(packed, face)));
    return result;
}

void writeFaceQuality(MeshModel& model, const Packed& packed, const std::vector<Scalarm>& quality) {
    model.updateDataMask(MeshModel::MM_FACEQUALITY);
    for (size_t face = 0; face < packed.faces.size(); ++face) packed.faces[face]->Q() = quality[face];
}

// ---- report ----

/// A figure of the mesh as it came and as it left.
struct Figure {
    const char* name;
    const char* label;
    QVariant before, after;
};

std::vector<Figure> compare(const qsm_measurement& before, const qsm_measurement& after) {
    const auto count = [](size_t number) { return int(number); };
    return {
        {"edge_ratio_mean", "edge ratio, mean", before.edge_ratio.mean, after.edge_ratio.mean},
        {"edge_ratio_variance", "edge ratio, variance", before.edge_ratio.variance, after.edge_ratio.variance},
        {"edge_ratio_max", "edge ratio, greatest", before.edge_ratio.max, after.edge_ratio.max},
        {"min_angle", "smallest angle (degrees)", before.min_angle.min, after.min_angle.min},
        {"max_angle", "largest angle (degrees)", before.max_angle.max, after.max_angle.max},
        {"shape_mean", "shape, mean", before.shape.mean, after.shape.mean},
        {"shape_min", "shape, least", before.shape.min, after.shape.min},
        {"below_20", "triangles below 20 degrees", count(before.below_20), count(after.below_20)},
        {"zero_area", "triangles without area", count(before.zero_area), count(after.zero_area)},
    };
}

struct Reason {
    const char* name;
    size_t qsm_kept::*count;
};

constexpr Reason REASONS[] = {
    {"unreferenced", &qsm_kept::unreferenced}, {"locked", &qsm_kept::locked},
    {"non_manifold", &qsm_kept::non_manifold}, {"degenerate", &qsm_kept::degenerate},
    {"boundary", &qsm_kept::boundary},         {"corner", &qsm_kept::corner},
    {"guard", &qsm_kept::guard},               {"deviation", &qsm_kept::deviation},
    {"settled", &qsm_kept::settled},
};

std::map<std::string, QVariant> outputValues(const qsm_report& report) {
    std::map<std::string, QVariant> values;
    for (const Figure& figure : compare(report.before, report.after)) {
        values[std::string(figure.name) + "_before"] = figure.before;
        values[std::string(figure.name) + "_after"] = figure.after;
    }
    for (const Reason& reason : REASONS) values[std::string("kept_") + reason.name] = int(report.kept.*reason.count);
    values["moved"] = int(report.moved);
    values["feature_edges"] = int(report.feature_edges);
    values["volume_relative_change"] = report.volume_relative_change;
    values["max_deviation"] = report.max_deviation;
    values["seconds"] = report.seconds.total;
    return values;
}

std::string formatted(const char* format, const char* label, const std::string& before, const std::string& after) {
    char line[200];
    std::snprintf(line, sizeof line, format, label, before.c_str(), after.c_str());
    return line;
}

std::string number(const QVariant& value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.6g", value.toDouble());
    return text;
}

std::string keptLine(const qsm_kept& kept) {
    std::string line;
    for (const Reason& reason : REASONS)
        if (const size_t count = kept.*reason.count)
            line += std::string(line.empty() ? "Kept in place: " : ", ") + reason.name + " " + std::to_string(count);
    return line;
}

std::vector<std::string> logLines(const qsm_report& report) {
    char line[200];
    std::snprintf(line, sizeof line, "Moved %zu of %zu vertices in %.3f s; volume changed by %.1e, deviation at most %.4g",
                  report.moved, report.before.vertices, report.seconds.total, report.volume_relative_change,
                  report.max_deviation);
    std::vector<std::string> lines = {line};
    const std::string kept = keptLine(report.kept);
    if (!kept.empty()) lines.push_back(kept);
    for (const Figure& figure : compare(report.before, report.after))
        lines.push_back(formatted("%s: %s -> %s", figure.label, number(figure.before), number(figure.after)));
    return lines;
}

}  // namespace

// ---- the host's interface ----

FilterQsmesh::FilterQsmesh() {
    typeList = {SMOOTH};
    for (const int filter : types()) actionList.push_back(new QAction(filterName(filter), this));
}

QString FilterQsmesh::pluginName() const { return "FilterQsmesh"; }

QString FilterQsmesh::filterName(int filter) const { return describe(filter).name; }

QString FilterQsmesh::filterInfo(int filter) const { return describe(filter).info; }

int FilterQsmesh::getPreConditions(FilterAction) const { return MeshModel::MM_FACENUMBER; }

int FilterQsmesh::postCondition(FilterAction) const {
    return MeshModel::MM_VERTCOORD | MeshModel::MM_VERTNORMAL | MeshModel::MM_FACENORMAL | MeshModel::MM_FACEQUALITY;
}

std::map<std::string, QVariant> FilterQsmesh::apply(int filter, MeshDocument& document, const RichParameterList& list,
                                                    vcg::CallBackPos* callback) {
    // Any other exception would end the host.
    try {
        describe(filter);
        if (!document.mm()) throw MLException("there is no layer to work on");
        return smooth(*document.mm(), list, callback);
    } catch (const MLException&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw MLException("working memory could not be had");
    } catch (const std::exception& error) {
        throw MLException(error.what());
    } catch (...) {
        throw MLException("unknown error");
    }
}

std::map<std::string, QVariant> FilterQsmesh::smooth(MeshModel& model, const RichParameterList& list,
                                                     vcg::CallBackPos* callback) {
    qsm_options options = readOptions(list);
    Packed packed = pack(model.cm);
    std::vector<uint8_t> lock;
    if (list.getBool("selected")) lock = lockUnselected(model.cm, packed);
    if (!lock.empty()) options.vertex_lock = lock.data();
    const qsm_report report = improve(packed, options, callback);
    // Whatever may fail comes before the layer changes.
    const bool withQuality = list.getBool("face_quality");
    std::vector<Scalarm> quality;
    if (withQuality) quality = shapes(packed);
    if (withQuality) writeFaceQuality(model, packed, quality);
    unpack(packed);
    updateBoxAndNormals(model);
    for (const std::string& line : logLines(report)) say(line);
    return outputValues(report);
}

#if QSMESH_MESHLAB_INTERFACE == 2020

void FilterQsmesh::say(const std::string& line) { Log(line); }

FilterQsmesh::FilterClass FilterQsmesh::getClass(QAction*) { return Smoothing; }

FilterQsmesh::FILTER_ARITY FilterQsmesh::filterArity(QAction*) const { return SINGLE_MESH; }

void FilterQsmesh::initParameterSet(QAction* action, MeshModel& model, RichParameterList& list) {
    addParameters(ID(action), list, model.cm);
}

bool FilterQsmesh::applyFilter(QAction* action, MeshDocument& document, const RichParameterList& list,
                               vcg::CallBackPos* callback) {
    try {
        apply(ID(action), document, list, callback);
        return true;
    } catch (const MLException& error) {
        errorMessage = QString::fromLocal8Bit(error.what());
        // meshlabserver shows the log alone.
        say(error.what());
        return false;
    }
}

#else

void FilterQsmesh::say(const std::string& line) { log(line); }

QString FilterQsmesh::vendor() const { return "qsmesh"; }

QString FilterQsmesh::pythonFilterName(int filter) const { return describe(filter).pythonName; }

FilterQsmesh::FilterClass FilterQsmesh::getClass(const QAction*) const { return Smoothing; }

FilterQsmesh::FilterArity FilterQsmesh::filterArity(const QAction*) const { return SINGLE_MESH; }

RichParameterList FilterQsmesh::initParameterList(const QAction* action, const MeshModel& model) {
    RichParameterList list;
    addParameters(ID(action), list, model.cm);
    return list;
}

std::map<std::string, QVariant> FilterQsmesh::applyFilter(const QAction* action, const RichParameterList& list,
                                                          MeshDocument& document, unsigned int& postConditionMask,
                                                          vcg::CallBackPos* callback) {
    auto values = apply(ID(action), document, list, callback);
    postConditionMask = MeshModel::MM_VERTCOORD | MeshModel::MM_VERTNORMAL | MeshModel::MM_FACENORMAL;
    if (list.getBool("face_quality")) postConditionMask |= MeshModel::MM_FACEQUALITY;
    return values;
}

#endif

MESHLAB_PLUGIN_NAME_EXPORTER(FilterQsmesh)

// Compiled here, so that the host's headers are read once.
#include "moc_filter_qsmesh.cpp"
