// SPDX-License-Identifier: GPL-3.0-or-later
/// qsmesh as filters of MeshLab 2020.09, 2022.02 and 2025.07: options in, progress, report out. All geometry is the
/// library's.
#ifndef QSMESH_FILTER_QSMESH_H
#define QSMESH_FILTER_QSMESH_H

#include <map>
#include <string>

#include <QObject>
#include <QVariant>

#include "host.h"

#if QSMESH_MESHLAB_INTERFACE == 2020
using FilterBase = MeshFilterInterface;
using FilterAction = QAction*;
#else
using FilterBase = FilterPlugin;
using FilterAction = const QAction*;
#endif

class FilterQsmesh : public QObject, public FilterBase {
    Q_OBJECT
#if QSMESH_MESHLAB_INTERFACE == 2020
    MESHLAB_PLUGIN_IID_EXPORTER(MESH_FILTER_INTERFACE_IID)
    Q_INTERFACES(MeshFilterInterface)
#else
    MESHLAB_PLUGIN_IID_EXPORTER(FILTER_PLUGIN_IID)
    Q_INTERFACES(FilterPlugin)
#endif

public:
    FilterQsmesh();

    QString pluginName() const override;
    QString filterName(int filter) const override;
    QString filterInfo(int filter) const override;
    int getPreConditions(FilterAction) const override;
    int postCondition(FilterAction) const override;

#if QSMESH_MESHLAB_INTERFACE == 2020
    FilterClass getClass(QAction*) override;
    FILTER_ARITY filterArity(QAction*) const override;
    void initParameterSet(QAction*, MeshModel&, RichParameterList&) override;
    bool applyFilter(QAction*, MeshDocument&, const RichParameterList&, vcg::CallBackPos*) override;
#else
    QString vendor() const override;
    QString pythonFilterName(int filter) const override;
    FilterClass getClass(const QAction*) const override;
    FilterArity filterArity(const QAction*) const override;
    RichParameterList initParameterList(const QAction*, const MeshModel&) override;
    std::map<std::string, QVariant> applyFilter(const QAction*, const RichParameterList&, MeshDocument&,
                                                unsigned int& postConditionMask, vcg::CallBackPos*) override;
#endif

private:
    /// Runs a filter on the current layer. Writes the log and returns the figures by name. Throws MLException and
    /// nothing else; the layer is then as it was.
    std::map<std::string, QVariant> apply(int filter, MeshDocument&, const RichParameterList&, vcg::CallBackPos*);
    void say(const std::string& line);
};

#endif
