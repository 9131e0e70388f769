// SPDX-License-Identifier: GPL-3.0-or-later
// A host that does to the plugin what MeshLab and PyMeshLab never do, but might: it listens to the progress, answers
// that enough is enough, throws; and it has deleted elements in a layer in double precision. Prints what is wrong; ends
// with 1 if anything is.
#include <cstdio>
#include <cstring>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include <QCoreApplication>
#include <QPluginLoader>

#include <common/plugins/interfaces/filter_plugin.h>
#include <vcg/complex/algorithms/create/platonic.h>

namespace {

int wrong = 0;

void require(bool holds, const std::string& what) {
    if (holds) return;
    std::printf("wrong: %s\n", what.c_str());
    ++wrong;
}

// ---- the host's side of progress, which knows no user pointer ----

std::vector<int> percents;
std::string text;
std::function<bool(int)> answer;

bool listen(int percent, const char* doing) {
    percents.push_back(percent);
    text = doing;
    return answer(percent);
}

// ---- layers ----

/// A sphere whose vertices have been pushed about on it; each carries its number as quality.
MeshModel& addSphere(MeshDocument& document, int subdivision) {
    MeshModel& layer = *document.addNewMesh("", "sphere");
    vcg::tri::Sphere(layer.cm, subdivision);
    unsigned state = 1;
    for (auto& vertex : layer.cm.vert) {
        for (int axis = 0; axis < 3; ++axis) {
            state = state * 1664525u + 1013904223u;
            vertex.P()[axis] += (double(state >> 8) / (1 << 24) - 0.5) * 0.04;
        }
        vertex.P().Normalize();
        vertex.Q() = double(vcg::tri::Index(layer.cm, vertex));
    }
    layer.updateBoxAndNormals();
    return layer;
}

/// Everything of a layer that an error must leave alone.
std::string snapshot(const MeshModel& layer) {
    std::string bytes;
    const auto add = [&](const void* from, size_t count) { bytes.append(static_cast<const char*>(from), count); };
    for (const auto& vertex : layer.cm.vert) {
        add(vertex.cP().V(), 3 * sizeof(Scalarm));
        add(vertex.cN().V(), 3 * sizeof(Scalarm));
        bytes += vertex.IsD() ? 'd' : ' ';
    }
    for (const auto& face : layer.cm.face) {
        bytes += face.IsD() ? 'd' : ' ';
        for (int corner = 0; corner < 3; ++corner) {
            const size_t number = vcg::tri::Index(layer.cm, face.cV(corner));
            add(&number, sizeof number);
        }
    }
    return bytes + std::to_string(layer.cm.vn) + " " + std::to_string(layer.cm.fn);
}

/// A tail_min_angle, degrees, that puts many triangles into the tail.
constexpr double MANY_TAILS = 40;

/// Applies a filter to the current layer. Returns the error, if any.
std::string apply(FilterPlugin& plugin, const QAction* filter, MeshDocument& document, double tailMinAngle,
                  std::function<bool(int)> answering) {
    percents.clear();
    answer = answering;
    RichParameterList options = plugin.initParameterList(filter, *document.mm());
    if (options.hasParameter("tail_min_angle")) options.setValue("tail_min_angle", FloatValue(float(tailMinAngle)));
    unsigned int changed = 0;
    try {
        plugin.applyFilter(filter, options, document, changed, listen);
        return "";
    } catch (const MLException& error) {
        return error.what();
    }
}

// ---- situations ----

void progressRises(FilterPlugin& plugin, const QAction* filter) {
    MeshDocument document;
    addSphere(document, 6);
    const std::string error = apply(plugin, filter, document, 20, [](int) { return true; });
    require(error.empty(), "an error where there is none: " + error);
    require(percents.size() > 3, "progress is hardly ever told");
    for (size_t k = 0; k < percents.size(); ++k) {
        require(percents[k] >= 0 && percents[k] <= 100, "progress of " + std::to_string(percents[k]));
        require(k == 0 || percents[k] > percents[k - 1], "progress does not rise");
    }
    require(text == filter->text().toStdString() + "...", "progress is about " + text);
}

void enoughIsEnough(FilterPlugin& plugin, const QAction* filter) {
    for (const int last : {0, 30, 80}) {
        MeshDocument document;
        const MeshModel& layer = addSphere(document, 4);
        const std::string before = snapshot(layer);
        const std::string error =
            apply(plugin, filter, document, MANY_TAILS, [last](int percent) { return percent < last; });
        require(error.find("cancel") != std::string::npos, "cancelled, it says: " + error);
        require(snapshot(layer) == before, "the layer has changed although the filter was cancelled");
        require(!percents.empty() && percents.back() >= last, "it was over before it was cancelled");
    }
}

void aCallbackThrows(FilterPlugin& plugin, const QAction* filter) {
    MeshDocument document;
    const MeshModel& layer = addSphere(document, 4);
    const std::string before = snapshot(layer);
    const auto fail = [](int) -> bool { throw std::runtime_error("a callback has failed"); };
    const std::string error = apply(plugin, filter, document, MANY_TAILS, fail);
    require(!error.empty(), "a callback has thrown and nobody noticed");
    require(snapshot(layer) == before, "the layer has changed although the callback has thrown");
}

void noCallback(FilterPlugin& plugin, const QAction* filter) {
    MeshDocument document;
    addSphere(document, 3);
    unsigned int changed = 0;
    const RichParameterList options = plugin.initParameterList(filter, *document.mm());
    const auto values = plugin.applyFilter(filter, options, document, changed, nullptr);
    require(values.at("moved").toInt() > 0, "nothing moves without a callback");
    require(changed & MeshModel::MM_VERTCOORD, "the host is not told that vertices have moved");
}

/// Deletes every seventh vertex and its faces.
void punch(MeshModel& layer) {
    for (auto& face : layer.cm.face)
        for (int corner = 0; corner < 3 && !face.IsD(); ++corner)
            if (vcg::tri::Index(layer.cm, face.V(corner)) % 7 == 3)
                vcg::tri::Allocator<CMeshO>::DeleteFace(layer.cm, face);
    for (auto& vertex : layer.cm.vert)
        if (vcg::tri::Index(layer.cm, vertex) % 7 == 3) vcg::tri::Allocator<CMeshO>::DeleteVertex(layer.cm, vertex);
}

void deletedElements(FilterPlugin& plugin, const QAction* filter) {
    MeshDocument punched, compacted;
    MeshModel &layer = addSphere(punched, 4), &clean = addSphere(compacted, 4);
    punch(layer);
    punch(clean);
    vcg::tri::Allocator<CMeshO>::CompactEveryVector(clean.cm);
    const size_t vertices = layer.cm.vert.size(), faces = layer.cm.face.size();
    for (MeshDocument* document : {&punched, &compacted}) {
        const std::string error = apply(plugin, filter, *document, MANY_TAILS, [](int) { return true; });
        require(error.empty(), "deleted elements: " + error);
    }
    const bool smoothing = filter->text().endsWith("smoothing");
    require((layer.cm.vert.size() == vertices && layer.cm.face.size() == faces) == smoothing,
            "deleted elements have their places after smoothing alone");
    vcg::tri::Allocator<CMeshO>::CompactEveryVector(layer.cm);
    require(snapshot(layer) == snapshot(clean), "deleted elements have changed the result");
    for (size_t k = 0; k < layer.cm.vert.size() && k < clean.cm.vert.size(); ++k)
        require(layer.cm.vert[k].Q() == clean.cm.vert[k].Q(), "a vertex carries another one's quality");
}

bool hasEvenEnds(const CFaceO& face, int edge) {
    return int(face.cV0(edge)->cQ()) % 2 == 0 && int(face.cV1(edge)->cQ()) % 2 == 0;
}

void edgesKeepTheirFlags(FilterPlugin& plugin, const QAction* filter) {
    MeshDocument document;
    MeshModel& layer = addSphere(document, 4);
    punch(layer);
    for (auto& face : layer.cm.face)
        for (int edge = 0; edge < 3 && !face.IsD(); ++edge)
            if (hasEvenEnds(face, edge)) face.SetFaceEdgeS(edge);
    vcg::tri::UpdateFlags<CMeshO>::FaceBorderFromNone(layer.cm);
    apply(plugin, filter, document, MANY_TAILS, [](int) { return true; });
    std::vector<bool> borders;
    size_t selected = 0;
    for (const auto& face : layer.cm.face)
        for (int edge = 0; edge < 3 && !face.IsD(); ++edge) {
            borders.push_back(face.IsB(edge));
            selected += face.IsFaceEdgeS(edge);
            require(!face.IsFaceEdgeS(edge) || hasEvenEnds(face, edge), "an edge is selected that was not");
        }
    require(selected > 100, "the selection of edges is lost");
    vcg::tri::UpdateFlags<CMeshO>::FaceBorderFromNone(layer.cm);
    size_t k = 0;
    for (const auto& face : layer.cm.face)
        for (int edge = 0; edge < 3 && !face.IsD(); ++edge, ++k)
            require(borders[k] == face.IsB(edge), "an edge is not marked as what it is, border or not");
}

}  // namespace

int main(int count, char** arguments) {
    QCoreApplication application(count, arguments);
    QPluginLoader loader(arguments[count - 1]);
    FilterPlugin* plugin = qobject_cast<FilterPlugin*>(loader.instance());
    if (!plugin) {
        std::printf("no plugin: %s\n", qPrintable(loader.errorString()));
        return 1;
    }
    for (const QAction* filter : plugin->actions()) {
        std::printf("%s\n", qPrintable(filter->text()));
        progressRises(*plugin, filter);
        enoughIsEnough(*plugin, filter);
        aCallbackThrows(*plugin, filter);
        noCallback(*plugin, filter);
        deletedElements(*plugin, filter);
        edgesKeepTheirFlags(*plugin, filter);
    }
    return wrong != 0;
}
