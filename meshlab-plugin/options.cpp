// SPDX-License-Identifier: GPL-3.0-or-later
#include "options.h"

#include <charconv>
#include <cmath>

#include "constraints.h"

namespace qsmesh {

namespace {

/// An option for experts; MeshLab 2022.02 and later show it on request only.
template <class Parameter, class... Arguments>
void addExpert(RichParameterList& list, const Arguments&... arguments) {
#if QSMESH_MESHLAB_INTERFACE == 2020
    list.addParam(Parameter(arguments...));
#else
    list.addParam(Parameter(arguments..., true));
#endif
}

qsm_options defaults() {
    qsm_options options;
    qsm_options_init(&options);
    return options;
}

void addScope(RichParameterList& list, const CMeshO& mesh) {
    list.addParam(RichBool("selected", anythingSelected(mesh), "Affect only selection",
                           "Changes only the selected vertices or, if no vertex is selected, the vertices all of whose "
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

void addTail(RichParameterList& list) {
    const qsm_options given = defaults();
    list.addParam(RichFloat("tail_edge_ratio", given.tail_edge_ratio, "Tail: edge ratio above",
                            QString("Longest over shortest edge above which a triangle is taken up for a cure, above "
                                    "1. Default: %1.")
                                .arg(given.tail_edge_ratio)));
    list.addParam(RichFloat("tail_min_angle", given.tail_min_angle, "Tail: smallest angle below (degrees)",
                            QString("Smallest angle below which a triangle is taken up for a cure, degrees, above 0 "
                                    "and below 60. Default: %1.")
                                .arg(given.tail_min_angle)));
    list.addParam(RichFloat("tail_max_angle", given.tail_max_angle, "Tail: largest angle above (degrees)",
                            QString("Largest angle above which a triangle is taken up for a cure, degrees, above 60 "
                                    "and below 180. Default: %1.")
                                .arg(given.tail_max_angle)));
    list.addParam(RichBool("flips", given.flips, "Flip edges everywhere",
                           "Flips, before the tail is treated, every edge inside the surface that is no feature where "
                           "the Delaunay criterion in the tangent plane asks for it. Off: edges are flipped only to "
                           "cure a triangle. Default: off."));
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

void addBorders(RichParameterList& list, const CMeshO& mesh) {
    list.addParam(RichBool("keep_seams", true, "Keep texture seams",
                           "Takes edges along which the texture coordinates of the faces' corners part as features. "
                           "Default: on."));
    list.addParam(RichBool("keep_color_borders", coloursAreRegions(mesh), "Keep borders of face colours",
                           QString("Takes edges between faces of different colours as features: right for materials, "
                                   "wrong for colours that show a quality. Default: on if the faces have 2 to %1 "
                                   "colours.")
                               .arg(MOST_REGION_COLOURS)));
}

void addExpertMethod(RichParameterList& list) {
    const qsm_options given = defaults();
    addExpert<RichEnum>(list, "order", given.order, QStringList{"colors", "index"}, "Order of the visits",
                        "Order in which a sweep visits the vertices: by colour, on all threads, or by vertex index, on "
                        "one. Default: colors.");
    addExpert<RichInt>(list, "threads", int(given.threads), "Threads",
                       QString("Threads at most, 0 to 1024; 0: as many as the machine runs at once. The result is the "
                               "same for any number. Default: %1.")
                           .arg(given.threads));
    addExpert<RichFloat>(list, "quality_floor", Scalarm(given.quality_floor), "Quality floor",
                         QString("Mean-ratio shape (0 no area, 1 equilateral) below which no star's worst triangle may "
                                 "fall, or fall further, 0 to 1. Default: %1.")
                             .arg(given.quality_floor));
    addExpert<RichFloat>(list, "interval_width", Scalarm(given.interval_width), "Interval width",
                         QString("Interval width of the sampling histogram, in units of edge ratio, 0.001 to 1000. "
                                 "Default: %1.")
                             .arg(given.interval_width));
    addExpert<RichFloat>(list, "sample_limit", Scalarm(given.sample_limit), "Sample limit",
                         QString("Edge ratio above which a sample counts as this one, at least 1. Default: %1.")
                             .arg(given.sample_limit));
}

void addExpertTail(RichParameterList& list) {
    const qsm_options given = defaults();
    addExpert<RichInt>(list, "tail_attempts", int(given.tail_attempts), "Tail: attempts",
                       QString("How often one triangle is taken up at most, 1 to 1000. Default: %1.")
                           .arg(given.tail_attempts));
    addExpert<RichInt>(list, "tail_operations", int(given.tail_operations), "Tail: operations",
                       QString("Operations on bad triangles that are carried out at most, over the whole mesh, from 0; "
                               "0: no bound. Default: %1.")
                           .arg(given.tail_operations));
}

void addOutput(Filter filter, RichParameterList& list) {
    list.addParam(RichBool("face_quality", false, "Write per-face quality",
                           "Stores the mean-ratio shape of each triangle (0 no area, 1 equilateral) as its quality, "
                           "for MeshLab's colorize filters. Default: off."));
    if (filter == IMPROVE)
        list.addParam(RichBool("select_leftovers", false, "Select what could not be cured",
                               "Selects the faces that are still in the tail afterwards, and no others. "
                               "Default: off."));
}

/// The value that was meant: a host keeps 1.2 as the float 1.2000000477, even if it computes in double precision, which
/// would be another option than everywhere else. The shortest decimal of the float is what somebody typed.
double meant(double value) {
    const float kept = float(value);
    if (double(kept) != value) return value;
    char text[64];
    double result = value;
    const auto end = std::to_chars(text, text + sizeof text, kept).ptr;
    std::from_chars(text, end, result);
    return result;
}

double number(const RichParameterList& list, const char* name) { return meant(list.getFloat(name)); }

/// A number that the library takes unsigned. It judges the upper end itself.
uint32_t count(const RichParameterList& list, const char* name, const char* range) {
    const int given = list.getInt(name);
    if (given < 0) throw MLException(QString("%1 is %2, not %3").arg(name).arg(given).arg(range));
    return uint32_t(given);
}

double featureAngle(const RichParameterList& list) {
    if (!list.getBool("features")) return 0;
    const double given = number(list, "feature_angle");
    // The library's 0 would quietly mean no features.
    if (given == 0) throw MLException("feature_angle is 0, not above 0; switch off Keep features instead");
    return given;
}

void readTail(const RichParameterList& list, qsm_options& options) {
    options.tail_edge_ratio = number(list, "tail_edge_ratio");
    options.tail_min_angle = number(list, "tail_min_angle");
    options.tail_max_angle = number(list, "tail_max_angle");
    options.tail_attempts = count(list, "tail_attempts", "in 1 to 1000");
    options.tail_operations = count(list, "tail_operations", "at least 0");
    options.flips = list.getBool("flips");
}

}  // namespace

void addParameters(Filter filter, RichParameterList& list, const CMeshO& mesh) {
    addScope(list, mesh);
    addMethod(list);
    if (filter == IMPROVE) addTail(list);
    addKept(list, mesh);
    addBorders(list, mesh);
    addExpertMethod(list);
    if (filter == IMPROVE) addExpertTail(list);
    addOutput(filter, list);
}

qsm_options readOptions(Filter filter, const RichParameterList& list) {
    qsm_options options = defaults();
    options.iterations = count(list, "iterations", "in 0 to 10000");
    options.relaxation = number(list, "relaxation");
    options.plane = list.getEnum("plane");
    options.ideal = list.getEnum("ideal");
    options.boundary = list.getEnum("boundary");
    options.order = list.getEnum("order");
    options.threads = count(list, "threads", "in 0 to 1024");
    options.feature_angle = featureAngle(list);
    const double deviation = meant(list.getAbsPerc("max_deviation"));
    options.max_deviation = deviation == 0 ? HUGE_VAL : deviation;
    options.quality_floor = number(list, "quality_floor");
    options.interval_width = number(list, "interval_width");
    options.sample_limit = number(list, "sample_limit");
    if (filter == IMPROVE) readTail(list, options);
    return options;
}

}  // namespace qsmesh
