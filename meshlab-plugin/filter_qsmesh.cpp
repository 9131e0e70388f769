// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_qsmesh.h"

#include <new>

#include "call.h"
#include "constraints.h"
#include "filters.h"
#include "layer.h"
#include "options.h"
#include "report.h"

using namespace qsmesh;

namespace {

/// Writes what has come out into the layer. Whatever may fail for lack of memory comes before the layer changes.
void write(Filter filter, const RichParameterList& list, MeshModel& model, Packed& packed, const Outcome& outcome) {
    std::vector<double> quality;
    if (list.getBool("face_quality")) {
        quality = shapes(packed);
        model.updateDataMask(MeshModel::MM_FACEQUALITY);
    }
    if (filter == IMPROVE) reconnect(model, packed, outcome.sources);
    reposition(model, packed);
    for (size_t face = 0; face < quality.size(); ++face) packed.faces[face]->Q() = Scalarm(quality[face]);
    if (filter == SMOOTH) return;
    if (list.getBool("select_leftovers")) {
        vcg::tri::UpdateSelection<CMeshO>::FaceClear(model.cm);
        for (const qsm_leftover& leftover : outcome.leftovers) packed.faces[leftover.triangle]->SetS();
    }
    compact(model);
}

/// Runs a filter on a layer, which is as it was if anything is thrown.
Outcome run(Filter filter, const RichParameterList& list, MeshModel& model, vcg::CallBackPos* callback) {
    qsm_options options = readOptions(filter, list);
    Packed packed = pack(model.cm);
    if (filter == IMPROVE) requirePureTriangles(packed);
    const Constraints constraints = readConstraints(filter, list, model.cm, packed);
    constraints.lendTo(options);
    Outcome outcome = call(filter, packed, options, callback);
    write(filter, list, model, packed, outcome);
    return outcome;
}

/// What a filter changes.
int changes(int filter) {
    if (filter == IMPROVE) return MeshModel::MM_GEOMETRY_AND_TOPOLOGY_CHANGE | MeshModel::MM_FACEFLAGSELECT;
    return MeshModel::MM_VERTCOORD | MeshModel::MM_VERTNORMAL | MeshModel::MM_FACENORMAL;
}

}  // namespace

FilterQsmesh::FilterQsmesh() {
    typeList = {SMOOTH, IMPROVE};
    for (const int filter : types()) actionList.push_back(new QAction(filterName(filter), this));
}

QString FilterQsmesh::pluginName() const { return "FilterQsmesh"; }

QString FilterQsmesh::filterName(int filter) const { return describe(filter).name; }

QString FilterQsmesh::filterInfo(int filter) const { return describe(filter).info; }

int FilterQsmesh::getPreConditions(FilterAction) const { return MeshModel::MM_FACENUMBER; }

int FilterQsmesh::postCondition(FilterAction action) const { return changes(ID(action)) | MeshModel::MM_FACEQUALITY; }

std::map<std::string, QVariant> FilterQsmesh::apply(int number, MeshDocument& document, const RichParameterList& list,
                                                    vcg::CallBackPos* callback) {
    // Any other exception would end the host.
    try {
        describe(number);
        const Filter filter = Filter(number);
        if (!document.mm()) throw MLException("there is no layer to work on");
        const Outcome outcome = run(filter, list, *document.mm(), callback);
        for (const std::string& line : logLines(filter, outcome)) say(line);
        return outputValues(filter, outcome);
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

#if QSMESH_MESHLAB_INTERFACE == 2020

void FilterQsmesh::say(const std::string& line) { Log(line); }

FilterQsmesh::FilterClass FilterQsmesh::getClass(QAction* action) {
    return ID(action) == IMPROVE ? Remeshing : Smoothing;
}

FilterQsmesh::FILTER_ARITY FilterQsmesh::filterArity(QAction*) const { return SINGLE_MESH; }

void FilterQsmesh::initParameterSet(QAction* action, MeshModel& model, RichParameterList& list) {
    addParameters(Filter(ID(action)), list, model.cm);
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

FilterQsmesh::FilterClass FilterQsmesh::getClass(const QAction* action) const {
    return ID(action) == IMPROVE ? Remeshing : Smoothing;
}

FilterQsmesh::FilterArity FilterQsmesh::filterArity(const QAction*) const { return SINGLE_MESH; }

RichParameterList FilterQsmesh::initParameterList(const QAction* action, const MeshModel& model) {
    RichParameterList list;
    addParameters(Filter(ID(action)), list, model.cm);
    return list;
}

std::map<std::string, QVariant> FilterQsmesh::applyFilter(const QAction* action, const RichParameterList& list,
                                                          MeshDocument& document, unsigned int& postConditionMask,
                                                          vcg::CallBackPos* callback) {
    auto values = apply(ID(action), document, list, callback);
    postConditionMask = changes(ID(action));
    if (list.getBool("face_quality")) postConditionMask |= MeshModel::MM_FACEQUALITY;
    return values;
}

#endif

MESHLAB_PLUGIN_NAME_EXPORTER(FilterQsmesh)

// Compiled here, so that the host's headers are read once.
#include "moc_filter_qsmesh.cpp"
