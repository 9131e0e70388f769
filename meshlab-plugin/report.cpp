// SPDX-License-Identifier: GPL-3.0-or-later
#include "report.h"

#include <cstdio>

namespace qsmesh {

namespace {

/// A figure of the mesh as it came and as it left.
struct Figure {
    const char* name;
    const char* label;
    QVariant before, after;
};

std::vector<Figure> compare(const qsm_measurement& before, const qsm_measurement& after) {
    const auto count = [](size_t number) { return int(number); };
    return {
        {"vertices", "vertices", count(before.vertices), count(after.vertices)},
        {"triangles", "triangles", count(before.triangles), count(after.triangles)},
        {"edge_ratio_mean", "edge ratio, mean", before.edge_ratio.mean, after.edge_ratio.mean},
        {"edge_ratio_variance", "edge ratio, variance", before.edge_ratio.variance, after.edge_ratio.variance},
        {"edge_ratio_max", "edge ratio, greatest", before.edge_ratio.max, after.edge_ratio.max},
        {"min_angle", "smallest angle (degrees)", before.min_angle.min, after.min_angle.min},
        {"max_angle", "largest angle (degrees)", before.max_angle.max, after.max_angle.max},
        {"shape_mean", "shape, mean", before.shape.mean, after.shape.mean},
        {"shape_min", "shape, least", before.shape.min, after.shape.min},
        {"below_20", "triangles below 20 degrees", count(before.below_20), count(after.below_20)},
        {"zero_area", "triangles without area", count(before.zero_area), count(after.zero_area)},
        {"volume", "volume", before.volume, after.volume},
    };
}

/// A number of things, under the library's name for what was done to them or why nothing was.
struct Count {
    const char* name;
    size_t count;
};

std::vector<Count> kept(const qsm_kept& kept) {
    return {
        {"unreferenced", kept.unreferenced}, {"locked", kept.locked},     {"non_manifold", kept.non_manifold},
        {"degenerate", kept.degenerate},     {"boundary", kept.boundary}, {"corner", kept.corner},
        {"guard", kept.guard},               {"deviation", kept.deviation}, {"settled", kept.settled},
    };
}

std::vector<Count> cures(const qsm_report& report) {
    return {
        {"tail_moved", report.tail_moved},       {"collapsed", report.collapsed},
        {"removed", report.removed},             {"flipped", report.flipped},
        {"general_flips", report.general_flips},
    };
}

std::vector<Count> leftovers(const std::vector<qsm_leftover>& leftovers) {
    std::vector<Count> reasons = {
        {"feature", 0},   {"locked", 0}, {"boundary", 0}, {"topology", 0},
        {"deviation", 0}, {"fold", 0},   {"no_gain", 0},
    };
    for (const qsm_leftover& leftover : leftovers) ++reasons.at(size_t(leftover.reason)).count;
    return reasons;
}

using Values = std::map<std::string, QVariant>;

void add(Values& values, const char* prefix, const std::vector<Count>& counts) {
    for (const Count& count : counts) values[std::string(prefix) + count.name] = int(count.count);
}

void addTail(Values& values, const Outcome& outcome) {
    const qsm_report& report = outcome.report;
    add(values, "", cures(report));
    add(values, "left_", leftovers(outcome.leftovers));
    values["tails_before"] = int(report.tails_before);
    values["tails_after"] = int(report.tails_after);
    values["vertices_removed"] = int(report.vertices_removed);
    values["triangles_removed"] = int(report.triangles_removed);
    values["triangles_unchanged"] = report.triangles_unchanged;
}

template <class... Arguments>
std::string formatted(const char* format, Arguments... arguments) {
    char line[200];
    std::snprintf(line, sizeof line, format, arguments...);
    return line;
}

std::string number(const QVariant& value) { return formatted("%.6g", value.toDouble()); }

/// "Title: name 3, other name 2"; those that are 0 are left out, and without any there is no line.
void addLine(std::vector<std::string>& lines, const char* title, const std::vector<Count>& counts) {
    std::string line;
    for (const Count& count : counts)
        if (count.count)
            line += (line.empty() ? std::string(title) + ": " : ", ") + count.name + " " + std::to_string(count.count);
    if (!line.empty()) lines.push_back(line);
}

void addTailLines(std::vector<std::string>& lines, const Outcome& outcome) {
    const qsm_report& report = outcome.report;
    lines.push_back(formatted("Tail: %zu triangles, %zu left; %.4f %% of the triangles have kept their vertices",
                              report.tails_before, report.tails_after, 100 * report.triangles_unchanged));
    addLine(lines, "Cures", cures(report));
    addLine(lines, "Left", leftovers(outcome.leftovers));
}

}  // namespace

std::map<std::string, QVariant> outputValues(Filter filter, const Outcome& outcome) {
    const qsm_report& report = outcome.report;
    Values values;
    for (const Figure& figure : compare(report.before, report.after)) {
        values[std::string(figure.name) + "_before"] = figure.before;
        values[std::string(figure.name) + "_after"] = figure.after;
    }
    add(values, "kept_", kept(report.kept));
    values["moved"] = int(report.moved);
    values["feature_edges"] = int(report.feature_edges);
    values["volume_relative_change"] = report.volume_relative_change;
    values["max_deviation"] = report.max_deviation;
    values["seconds"] = report.seconds.total;
    if (filter == IMPROVE) addTail(values, outcome);
    return values;
}

std::vector<std::string> logLines(Filter filter, const Outcome& outcome) {
    const qsm_report& report = outcome.report;
    std::vector<std::string> lines = {
        formatted("Moved %zu of %zu vertices in %.3f s; volume changed by %.1e, deviation at most %.4g", report.moved,
                  report.before.vertices, report.seconds.total, report.volume_relative_change, report.max_deviation)};
    addLine(lines, "Kept in place", kept(report.kept));
    if (filter == IMPROVE) addTailLines(lines, outcome);
    for (const Figure& figure : compare(report.before, report.after))
        lines.push_back(std::string(figure.label) + ": " + number(figure.before) + " -> " + number(figure.after));
    return lines;
}

}  // namespace qsmesh
